"""Beginnings of two folders beside each other."""

from __future__ import annotations

from collections.abc import Iterator

# Most differences that are told.
MOST_TOLD = 4
# Most letters of a value that are told.
MOST_LETTERS = 40


def _parts(value: object, place: str = "") -> Iterator[tuple[str, object]]:
    """Everything in a value of JSON that has no parts of its own, with its place; what has a name by that."""
    if isinstance(value, dict):
        pairs = value.items()
    elif isinstance(value, list):
        named = [part.get("name") if isinstance(part, dict) else None for part in value]
        pairs = ((name or number, part) for number, (name, part) in enumerate(zip(named, value, strict=True)))
    else:
        yield place, value
        return
    for key, part in pairs:
        yield from _parts(part, f"{place}.{key}" if place else str(key))


def _words(value: object) -> str:
    text = "missing" if value is None else str(value)
    return text if len(text) <= MOST_LETTERS else f"{text[:MOST_LETTERS]}…"


def differences(theirs: dict, own: dict) -> list[str]:
    """Differences between the beginning of their folder and that of the own one, in words; none of equal ones."""
    if theirs == own:
        return []
    there, here = dict(_parts(theirs)), dict(_parts(own))
    apart = [place for place in {**here, **there} if there.get(place) != here.get(place)]
    told = [f"{place} is {_words(there.get(place))} there and {_words(here.get(place))} here" for place in apart]
    more = len(told) - MOST_TOLD
    return told[:MOST_TOLD] + ([f"{more} more differ"] if more > 0 else []) or ["its order is another"]
