"""What the report and the article refer to, by the names under which the article cites it."""

REFERENCES = {
    "alexa": "M. Alexa, D. Cohen-Or and D. Levin: As-rigid-as-possible shape interpolation. Proceedings of "
    "SIGGRAPH 2000, 157-164.",
    "chen": "R. Chen, O. Weber, D. Keren and M. Ben-Chen: Planar shape interpolation with bounded distortion. "
    "ACM Transactions on Graphics 32 (2013).",
    "conway": "J. H. Conway and H. S. M. Coxeter: Triangulated polygons and frieze patterns. The Mathematical "
    "Gazette 57 (1973), 87-94.",
    "dym": "N. Dym, A. Shtengel and Y. Lipman: Homotopic morphing of planar curves. Computer Graphics Forum 34"
    " (2015), Symposium on Geometry Processing.",
    "mukherjee": "U. Mukherjee and M. Gopi: Tweening boundary curves of non-simple immersions of a disk. University "
    "of California, Irvine. The copy that we have names neither venue nor year.",
    "sederberg": "T. W. Sederberg, P. Gao, G. Wang and H. Mu: 2-D shape blending: an intrinsic solution to the "
    "vertex path problem. Proceedings of SIGGRAPH 1993. doi:10.1145/166117.166118",
    "shewchuk": "J. R. Shewchuk: Adaptive precision floating-point arithmetic and fast robust geometric predicates."
    " Discrete and Computational Geometry 18 (1997).",
    "shor": "P. W. Shor and C. J. Van Wyk: Detecting and decomposing self-overlapping curves. Computational "
    "Geometry 2 (1992), 31-50.",
    "surazhsky": "V. Surazhsky and C. Gotsman: Controllable morphing of compatible planar triangulations. ACM "
    "Transactions on Graphics 20 (2001).",
}
