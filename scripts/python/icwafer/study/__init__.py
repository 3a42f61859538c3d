# SPDX-License-Identifier: GPL-2.0-or-later
"""Batch renders: a study describes many pictures, and is rendered whatever happens meanwhile.

    fields     which settings of a scene there are, and what each allows
    document   a study file becomes a Study: settings and axes
    plan       a Study becomes jobs, each with a key (keys) of all that its result depends on
    store      the folder of results: what is finished, and how a result appears in it
    order      what is rendered, where and with what
    local      renders jobs on this machine with worker processes (workers)
    worker     Blender's side of that
    slurm      has a cluster do the same; slurm_task runs on its nodes
    run        from a study file to a folder of results
    command    the command line
"""
