"""Results that are plain tuples with names."""

from collections import namedtuple

Contacts = namedtuple("Contacts", "items witnesses bodies pairs aged queried added dropped moved rebuilt memory")
Contacts.__doc__ = """The pairs of a world that are not proven farther than the margin, sorted by a, then b.

items: an array of records a, b (ids), part_a, part_b, status, stage, limit, iterations, lower, upper. witnesses: beside
them point_a, point_b, normal of distances and depths, else None. The rest counts what the step did (docs/world.md)."""

Hit = namedtuple("Hit", "a b lower answer")
Hit.__doc__ = """A pair that a query of a world found: ids, or a: 0 of a probe, its number of several; the Answer.

lower: of nearest ones, no pair is nearer. The answer of compounds has no proof for the other parts: check() wants that of
distance(..., earlier=answer)."""

Cast = namedtuple("Cast", "body part probe lower upper point normal undecided")
Cast.__doc__ = """The first hit of a ray or of a moved body: the id, lower <= t <= upper, the body's point and its normal."""
