#!/usr/bin/env python3
"""What a frame would take on machines that are not at hand: two bounds for each pass, from what its plan says and what is measured here.

The lower bound is memory: every buffer that a pass reads or writes goes over the bus once, those with a value for each pixel as far
as the tiles reach that show something, and each pass takes a few microseconds to start. Caches, atomics that collide, and what is read
twice are left out, so no device is faster.

The upper bound is arithmetic: the time measured here, by the ratio of what both machines compute at best in single precision. A software
adapter fills its vectors worse than a graphics card its own, and follows every branch; so a card should be faster than that.

The first is held against this machine too, whose bandwidth and arithmetic are measured with numpy: how many times its bound a pass takes
here tells by how much it is not memory that it waits for.

    experiments/model/predict.py --cutaway target/release/cutaway

Needs numpy and Pillow. Predictions, never to stand where a measurement belongs.
"""

import argparse
import json
import subprocess
import tempfile
import time
from multiprocessing import Pool
from pathlib import Path

import numpy as np
from PIL import Image

TILE_PX = 16

# Bytes a second, single precision operations a second, seconds to start a pass. Of the makers' data sheets: NVIDIA H100 SXM5 (3.35 TB/s,
# 67 TFLOP/s) and GeForce RTX 4060 Laptop (256 GB/s, 3072 cores at 2.37 GHz with two operations each).
DEVICES = {
    "H100": (3.35e12, 67e12, 4e-6),
    "RTX 4060 laptop": (256e9, 14.6e12, 4e-6),
}

SCENES = {
    "crank, plane": ["shape:crank", "--section", "-z=50%"],
    "crank, relief": [
        "shape:crank", "--section", "-z=50%", "--relief", "fractal:seed=7,amplitude=4%,period=45%",
    ],
    "torus 1 M, plane": ["shape:torus?segments=1118&sides=448", "--section", "z=50%"],
}


def copied(_):
    """Bytes a second that a core moves when it copies what fits no cache."""
    source = np.ones(1 << 25, dtype=np.float32)
    target = np.empty_like(source)
    np.copyto(target, source)
    began = time.perf_counter()
    for _ in range(8):
        np.copyto(target, source)
    return 8 * 2 * source.nbytes / (time.perf_counter() - began)


def multiplied():
    """Operations a second of a product of matrices, by all cores."""
    a = np.ones((2048, 2048), dtype=np.float32)
    a @ a
    began = time.perf_counter()
    for _ in range(4):
        a @ a
    return 4 * 2 * 2048**3 / (time.perf_counter() - began)


def run(*command):
    return subprocess.run(command, check=True, capture_output=True, text=True).stdout


def share_of_tiles(cutaway, scene, size, folder):
    """The share of the tiles of the picture in which something is shown."""
    path = Path(folder) / "shown.png"
    words = ["--resolution", f"{size[0]},{size[1]}", "--supersample", "1", "--style", "clay"]
    # The view of compare, which shows the whole model.
    words += ["--background", "none", "--camera-fit", "all", "-o", str(path)]
    run(cutaway, "render", *scene, *words)
    alpha = np.asarray(Image.open(path).convert("RGBA"))[:, :, 3]
    rows, columns = (-(-n // TILE_PX) for n in alpha.shape)
    padded = np.zeros((rows * TILE_PX, columns * TILE_PX), dtype=np.uint8)
    padded[: alpha.shape[0], : alpha.shape[1]] = alpha
    tiles = padded.reshape(rows, TILE_PX, columns, TILE_PX).max(axis=(1, 3))
    return float((tiles > 0).mean())


def passes_of(cutaway, scene, method, size):
    """The passes of a frame by a method, with the bytes of what each reads and writes."""
    words = ["--strategy", method, "--resolution", f"{size[0]},{size[1]}", "--json", "-"]
    plan = json.loads(run(cutaway, "plan", *scene, *words))
    bytes_of = {r["name"]: r["bytes"] for r in plan["resources"]}
    return [(p["name"], [bytes_of[n] for n in p["reads"] + p["writes"]]) for p in plan["passes"] if p["clock"] == "frame"]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--cutaway", default="target/release/cutaway")
    parser.add_argument("--method", default="raycast+mask@compute")
    parser.add_argument("--rounds", default="9")
    args = parser.parse_args()
    size = [1024, 768]
    with Pool() as pool:
        here = sum(pool.map(copied, range(pool._processes)))
    arithmetic = multiplied()
    print(f"here: {here / 1e9:.1f} GB/s, {arithmetic / 1e9:.0f} GFLOP/s\n")
    with tempfile.TemporaryDirectory() as folder:
        for name, scene in SCENES.items():
            found = Path(folder) / "found.json"
            words = ["--strategies", args.method, "--rounds", args.rounds, "--resolution", f"{size[0]},{size[1]}"]
            run(args.cutaway, "compare", *scene, *words, "--json", str(found))
            strategy = json.loads(found.read_text())["strategies"][0]
            measured = {p["name"]: p["median_ms"] / 1e3 for p in strategy["passes"]}
            share = share_of_tiles(args.cutaway, scene, size, folder)
            print(f"## {name}: something is shown in {100 * share:.0f} % of the tiles\n")
            devices = " | ".join(f"{d}, us" for d in DEVICES)
            print(f"| pass | MB | here, ms | x its bound | {devices} |")
            print("|---|---:|---:|---:|" + "---:|" * len(DEVICES))
            total = [0.0, 0.0, 0.0, [[0.0, 0.0] for _ in DEVICES]]
            for label, buffers in passes_of(args.cutaway, scene, args.method, size):
                if label not in measured:
                    # A plan that asks no adapter has the second sweep of those without 64-bit atomics.
                    continue
                pixels = 4 * size[0] * size[1]
                moved = sum(b * share if b >= pixels and b % pixels == 0 else b for b in buffers)
                took = measured[label]
                bounds = [
                    (start + moved / bandwidth, start + took * arithmetic / operations)
                    for bandwidth, operations, start in DEVICES.values()
                ]
                for sums, (low, high) in zip(total[3], bounds):
                    sums[0] += min(low, high)
                    sums[1] += max(low, high)
                total[0] += moved
                total[1] += took
                total[2] += moved / here
                row = " | ".join(f"{1e6 * min(b):.0f} to {1e6 * max(b):.0f}" for b in bounds)
                print(f"| {label} | {moved / 1e6:.1f} | {took * 1e3:.1f} | {took * here / max(moved, 1):.0f} | {row} |")
            row = " | ".join(f"{1e6 * low:.0f} to {1e6 * high:.0f}" for low, high in total[3])
            times = total[1] / total[2]
            print(f"| all | {total[0] / 1e6:.1f} | {total[1] * 1e3:.1f} | {times:.0f} | {row} |\n", flush=True)


if __name__ == "__main__":
    main()
