"""What a shard should hold: 10,000 points on 64 workers, simulated, with points of unlike cost, slow workers and lost ones.

    python3 experiments/cluster/simulate.py [--points N] [--workers N] [--seeds N]

A point costs what a log-normal distribution says, with a median of 20 s, and a guess of its cost is off by a factor. A worker is as fast as
another but for some per cent, and one in 64 is half as fast. Each shard costs some seconds before its first point. Compared are
ways to divide points among shards and to order the shards in the queue; the number told is the time until the last point is there, over the
time that would be taken if all workers worked to the same second (sum of costs over sum of speeds).
"""

import argparse
import heapq
import random
import statistics

START_S = 3.0
MEDIAN_S = 20.0
SPREAD = 1.0
SLOW = 0.5
LOST = 0.02


def costs(points, guess_spread, rng):
    true = [MEDIAN_S * rng.lognormvariate(0, SPREAD) for _ in range(points)]
    return true, [cost * rng.lognormvariate(0, guess_spread) for cost in true]


def rows(guessed, shards):
    n = len(guessed)
    return [list(range(n * k // shards, n * (k + 1) // shards)) for k in range(shards)]


def dealt(guessed, shards):
    return [list(range(k, len(guessed), shards)) for k in range(shards)]


def longest_first(guessed, shards):
    """As `cutaway measure --shard` does: by falling cost, each to the shard that has least so far (Graham 1969)."""
    heap = [(0.0, k) for k in range(shards)]
    made = [[] for _ in range(shards)]
    for point in sorted(range(len(guessed)), key=lambda p: -guessed[p]):
        load, k = heapq.heappop(heap)
        made[k].append(point)
        heapq.heappush(heap, (load + guessed[point], k))
    return made


def makespan(true, shards, speeds, lost, rng):
    """Workers take shard after shard from a queue. A shard that is lost ends at a random place; what it has is kept, and the rest is
    submitted again when the queue is empty."""
    free = [(0.0, w) for w in range(len(speeds))]
    heapq.heapify(free)
    queue = list(shards)
    last = 0.0
    while queue:
        again = []
        for shard in queue:
            now, w = heapq.heappop(free)
            whole = shard
            if lost and rng.random() < lost:
                keep = rng.randrange(len(shard) + 1)
                again.append(shard[keep:])
                shard = shard[:keep]
                # The point that it was at is lost.
                extra = true[whole[keep]] * rng.random() if keep < len(whole) else 0.0
            else:
                extra = 0.0
            now += (START_S + sum(true[p] for p in shard) + extra) / speeds[w]
            last = max(last, now)
            heapq.heappush(free, (now, w))
        queue = [shard for shard in again if shard]
    return last


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--points", type=int, default=10_000)
    parser.add_argument("--workers", type=int, default=64)
    parser.add_argument("--seeds", type=int, default=10)
    options = parser.parse_args()
    ways = [("rows", rows), ("dealt round", dealt), ("longest first", longest_first)]
    header = ["division", "shards", "points each", "exact guess", "guess off x 2", "one slow in 64", "2 % lost"]
    print("| " + " | ".join(header) + " |\n|" + "---|" * len(header))
    for name, divide in ways:
        for factor in (1, 2, 4, 8, 16, 40):
            shards_n = options.workers * factor
            cells = []
            for guess_spread, slow, lost in ((0.0, 0, 0.0), (0.7, 0, 0.0), (0.7, 1, 0.0), (0.7, 1, LOST)):
                found = []
                for seed in range(options.seeds):
                    rng = random.Random(seed)
                    true, guessed = costs(options.points, guess_spread, rng)
                    speeds = [rng.uniform(0.95, 1.05) for _ in range(options.workers)]
                    for w in range(slow * options.workers // 64):
                        speeds[w] = SLOW
                    best = sum(true) / sum(speeds)
                    found.append(makespan(true, divide(guessed, shards_n), speeds, lost, rng) / best)
                cells.append(f"{statistics.median(found):.2f}")
            print(f"| {name} | {shards_n} | {options.points // shards_n} | " + " | ".join(cells) + " |")


if __name__ == "__main__":
    main()
