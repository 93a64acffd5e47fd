"""What the report and the article refer to."""

REFERENCES = (
    "M. Alexa, D. Cohen-Or and D. Levin: As-rigid-as-possible shape interpolation. SIGGRAPH 2000.",
    "R. Chen, O. Weber, D. Keren and M. Ben-Chen: Planar shape interpolation with bounded distortion. ACM Transactions "
    "on Graphics 32 (2013).",
    "J. H. Conway and H. S. M. Coxeter: Triangulated polygons and frieze patterns. The Mathematical Gazette 57 (1973).",
    "U. Mukherjee and M. Gopi: Tweening boundary curves of non-simple immersions of a disk.",
    "T. W. Sederberg, P. Gao, G. Wang and H. Mu: 2-D shape blending: an intrinsic solution to the vertex path problem. "
    "SIGGRAPH 1993.",
    "J. R. Shewchuk: Adaptive precision floating-point arithmetic and fast robust geometric predicates. Discrete and "
    "Computational Geometry 18 (1997).",
    "P. W. Shor and C. J. Van Wyk: Detecting and decomposing self-overlapping curves. Computational Geometry 2 (1992).",
    "V. Surazhsky and C. Gotsman: Controllable morphing of compatible planar triangulations. ACM Transactions on "
    "Graphics 20 (2001).",
)
