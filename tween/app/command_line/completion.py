"""What a shell completes: commands and options by click, files by the shell, and the curves that come with tween."""

import os
import sys
from collections.abc import Iterable

import click
from click.shell_completion import CompletionItem, shell_complete

_VARIABLE = "_TWEEN_COMPLETE"


def complete(command: click.Command) -> int | None:
    """Answer the shell, where it is the shell that asks.

    Parameters
    ----------
    command : Command

    Returns
    -------
    int or None
        Exit status; None where a person asks.  The shell asks by the environment variable ``_TWEEN_COMPLETE``:
        ``bash_source`` (or zsh, fish) for the script that sets completion up, and then for each completion.
    """
    instruction = os.environ.get(_VARIABLE)
    if not instruction:
        return None
    status = shell_complete(command, {}, "tween", _VARIABLE, instruction)
    if status and not instruction.endswith("_complete"):
        print(
            f"tween: {_VARIABLE} is {instruction!r}, expected bash_source, zsh_source or fish_source", file=sys.stderr
        )
        return 2
    return status


def names(context: click.Context, parameter: click.Parameter, incomplete: str) -> list[CompletionItem]:
    """List curves that come with tween, with their kind and without.

    Parameters
    ----------
    context : Context
    parameter : Parameter
    incomplete : str

    Returns
    -------
    list of CompletionItem
    """
    full = _full_names()
    return _beginning([*full, *(name.partition(":")[2] for name in full)], incomplete)


def shapes(context: click.Context, parameter: click.Parameter, incomplete: str) -> list[CompletionItem]:
    """List curves that come with tween, or leave it to the shell to list files.

    Parameters
    ----------
    context, parameter, incomplete
        As in `names`.

    Returns
    -------
    list of CompletionItem
    """
    curves = _beginning([*_full_names(), "disk"], incomplete) if incomplete else []
    return curves or [CompletionItem(incomplete, type="file")]


def _full_names() -> list[str]:
    from tween.app.command_line import curve_names  # here, as it imports numpy

    return curve_names.every_name()


def _beginning(words: Iterable[str], incomplete: str) -> list[CompletionItem]:
    return [CompletionItem(word) for word in words if word.startswith(incomplete)]
