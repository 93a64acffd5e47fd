"""Studies of what the paper claims, on curves of our own; `catalogue` lists them, `reproduce` runs them all.

    studies     one module per study, which writes to results/ what is named after it
    claims      the verdict on every claim, one file per section of the paper
    figures     the paper's, and the studies'
    report      everything on one page
    benchmarks  times, beside peers

What they share stands here: what is morphed (`subjects`), what is measured (`measures`), what others use
(`baselines`), and where results are kept (`store`).
"""
