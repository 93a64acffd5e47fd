"""The errors of tween: one root, and a ValueError wherever the input is at fault; and its one warning."""


class TweenError(Exception):
    """Root of every error that tween raises on purpose."""


class CurveError(TweenError, ValueError):
    """The points are no polygon that tween can treat; the message names the vertex."""


class TriangulationError(TweenError, ValueError):
    """The triangles do not triangulate a disk on the curve; the message names the broken rule."""


class NotSelfOverlappingError(TweenError, ValueError):
    """The curve bounds no immersed disk; the message is `Decomposition.reason`."""


class IncompatibleError(TweenError, ValueError):
    """Two curves or triangulations cannot be matched as asked; the message says what would work."""


class MotionError(TweenError):
    """A shape on the way cannot be written down in doubles; the message says when, and which vertex."""


class GuaranteeError(TweenError):
    """A morph was asked for with a guarantee that cannot be given; the message says where, when and why."""


class FileError(TweenError, ValueError):
    """A file cannot be read or written as asked; the message names the file and what was expected."""


class NotUsedWarning(UserWarning):
    """A file holds something that is not used; the message names the file, and what it is."""
