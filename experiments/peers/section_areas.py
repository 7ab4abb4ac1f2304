#!/usr/bin/env python3
"""Section areas of cutaway against those of two others, for many planes: trimesh with shapely, and VTK. See README.md.

    cargo test -p cutaway-tests --test it areas_of_closed -- --nocapture | grep '^section ' > sections.txt
    target/peers-venv/bin/python experiments/peers/section_areas.py DATA < sections.txt

Each line of input is `section FILE px py pz nx ny nz area perimeter`; FILE is relative to DATA, in which each file is one part.
Areas are even-odd. Prints one row per section and the worst relative differences; ends with 1 if one is beyond 1e-6.
"""

import sys
from pathlib import Path

import numpy as np
import trimesh
import vtk

import meshes
import sections

LIMIT = 1e-6


def main():
    folder = Path(sys.argv[1])
    print(f"trimesh {trimesh.__version__}, VTK {vtk.vtkVersion.GetVTKVersion()}")
    print("| file | area by us | trimesh | VTK | relative differences |\n| --- | --- | --- | --- | --- |")
    held, worst = {}, {}
    for line in sys.stdin:
        _, name, *numbers = line.split()
        origin, normal = np.array(numbers[:3], float), np.array(numbers[3:6], float)
        ours = float(numbers[6])
        if name not in held:
            mesh = meshes.read(folder / name, name, True)
            # One at a time: they are large, and come in order.
            held = {name: (mesh.trimesh, sections.as_vtk(mesh))}
        mesh, data = held[name]
        loops = [sections.trimesh_section(mesh, origin, normal), sections.vtk_loops(data, origin, normal)]
        theirs = [sections.even_odd(found) for found in loops]
        off = [abs(ours - area) / max(ours, area, 1e-300) for area in theirs]
        worst[name] = [max(pair) for pair in zip(worst.get(name, [0, 0]), off)]
        print(f"| {name} | {ours:.12g} | {theirs[0]:.12g} | {theirs[1]:.12g} | {off[0]:.1e} {off[1]:.1e} |")
    print("\nworst relative differences (trimesh, VTK)")
    for name, pair in worst.items():
        print(f"{name}: {pair[0]:.1e} {pair[1]:.1e}")
    if not worst:
        print("no sections on standard input: see --nocapture above")
        return 2
    return int(any(max(pair) > LIMIT for pair in worst.values()))


if __name__ == "__main__":
    sys.exit(main())
