"""Counts of things in words."""


def counted(number: int, name: str) -> str:
    """Write a number of things.

    Parameters
    ----------
    number : int
    name : str
        Of one of them; its plural ends in s.

    Returns
    -------
    str

    Examples
    --------
    >>> counted(0, "flip"), counted(1, "flip"), counted(2, "flip")
    ('no flips', '1 flip', '2 flips')
    """
    return f"{number} {name}" if number == 1 else f"{number or 'no'} {name}s"
