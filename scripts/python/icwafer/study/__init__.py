# SPDX-License-Identifier: GPL-2.0-or-later
"""Batch renders: a study describes many pictures, and is rendered whatever happens meanwhile.

    fields     which settings of a scene there are, and what each allows
    document   a study file becomes a Study: settings and axes
    plan       a Study becomes jobs, each with a key made from all that its result depends on
    store      the folder of results: what is finished, and how a result appears in it
    local      renders jobs with worker processes on this machine; worker runs inside Blender
    slurm      has a cluster do the same
    command    the command line
"""
