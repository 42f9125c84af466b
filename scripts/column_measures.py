"""What a column that was set free is judged by, discs and sand alike (for dem_against_mpm.py)."""
import math

FALLEN = 0.15       # of the height: a grain that moved by more has fallen with the column
STANDS = 0.1        # of the grains: a column of which fewer have fallen stands
FRONT = 0.99        # of the grains are behind it
BINS = 48           # of a profile


def measured(before, after, width, tall, span):
    """Of points (x, height) of equal mass, each at the same place in both lists: the front over
    the width, the share that has fallen, and the profile, the height over the distance that the
    material would have as densely packed as in the column, over the column's height."""
    places = sorted(x for x, _ in after)
    moved = sum(math.dist(p, q) > FALLEN * tall for p, q in zip(before, after)) / len(after)
    step = span / BINS
    profile = [0.0] * BINS
    for x in places:
        profile[min(BINS - 1, max(0, int(x / step)))] += width / (step * len(after))
    front = places[min(len(places) - 1, int(FRONT * len(places)))]
    return {"before": before, "after": after, "run_out": front / width - 1,
            "fallen": moved, "stands": moved <= STANDS, "profile": profile,
            "centre": sum(y for _, y in after) / len(after) / tall}


def gap(profile, other, span, width):
    """The share of the material that lies elsewhere in one profile than in the other."""
    step = span / BINS / width
    return 0.5 * sum(abs(a - b) for a, b in zip(profile, other)) * step


def limit(columns):
    """Of [(strength, stands)]: (strongest that falls, weakest above it that stands); nothing where
    all do the same."""
    columns = sorted(columns)
    falling = [c for c, stands in columns if not stands]
    low = max(falling) if falling else None
    standing = [c for c, stands in columns if stands and (low is None or c > low)]
    return low, (min(standing) if standing else None)
