def engine(x): pass
