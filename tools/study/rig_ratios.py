#!/usr/bin/env python3
"""Spatial error of the polynomial rigs against the paper's, object by object, as a Markdown table; with --dropped that of
the models which the paper tried and dropped, against others of as many SH vectors or projections.

Runs `rigel report` without near lights over the built-in scenes and, where it is given, a folder of real assets
(characters/, vehicles/, scenes/ as in the project's shared data), all clips. Usage:
    tools/study/rig_ratios.py [--dropped] [--rigel build/release/rigel] [--data FOLDER]
"""
import argparse
import json
import math
import subprocess
import sys
import tempfile

PAIRS = [("poly:12", "lattice:8x4x2"), ("poly:6", "mixed:l3,g,c"), ("lattice:3x2x2@gauss", "lattice:3x2x2"),
         ("invquad:6", "poly:6")]
DROPPED = [("latticegrad:3x1x1", "lattice:3x2x2"), ("hermite:3x1x1", "lattice:3x2x2"),
           ("latticegrad:4x2x2", "lattice:8x4x2"), ("hermite:4x2x2", "lattice:8x4x2"), ("rbf:6", "mixed:l3,g,c"),
           ("rbf:6", "lattice:3x2x2"), ("rbf:12", "lattice:3x2x2"), ("rbf:32", "lattice:8x4x2"), ("rbf:6", "poly:6"),
           ("rbf:12", "poly:12"), ("rbf:48", "poly:48")]
SAMPLES = ["street", "stage", "dragon", "touch", "figure1"]
ASSETS = ["characters/soldier/soldier1.gltf", "characters/Fox.glb", "vehicles/car/car.gltf",
          "scenes/collisions_level/level.gltf"]
DONORS = ["sample:street", "sample:dragon"]


def measure(rigel, pairs, scene, lights):
    specs = ";".join(dict.fromkeys(spec for pair in pairs for spec in pair))
    with tempfile.TemporaryDirectory() as out:
        command = [rigel, "report", scene, "--clip", "all", "--rig", specs, "--no-images", "--quiet", "--json", "--out", out]
        if lights:
            command += ["--lights", lights]
        done = subprocess.run(command, capture_output=True, text=True)
        if done.returncode != 0:
            sys.exit(done.stderr.strip())
        return json.loads(done.stdout)["objects"]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--rigel", default="build/release/rigel")
    parser.add_argument("--data", help="folder with characters/, vehicles/ and scenes/")
    parser.add_argument("--dropped", action="store_true", help="rbf, latticegrad and hermite")
    arguments = parser.parse_args()
    pairs = DROPPED if arguments.dropped else PAIRS

    runs = [("sample:" + name, "") for name in SAMPLES]
    if arguments.data:
        runs += [(f"{arguments.data}/{asset}", donor) for asset in ASSETS for donor in DONORS]

    print("| object | clip | lights | " + " | ".join(f"{a} / {b}" for a, b in pairs) + " |")
    print("|---|---|---|" + "---|" * len(pairs))
    ratios = [[] for _ in pairs]
    for scene, lights in runs:
        for item in measure(arguments.rigel, pairs, scene, lights):
            rms = {rig["spec"]: rig["spatial"]["rms"] for rig in item["rigs"]}
            cells = []
            for i, (a, b) in enumerate(pairs):
                ratio = rms[a] / rms[b]
                ratios[i].append(ratio)
                cells.append(f"{rms[a]:.4f} / {rms[b]:.4f} = {ratio:.2f}")
            name = f"{item['name']} of {scene.split('/')[-1]}"
            print(f"| {name} | {item.get('clip', '')} | {lights or 'its own'} | " + " | ".join(cells) + " |")
    means = [math.exp(sum(map(math.log, r)) / len(r)) for r in ratios]
    print("| **geometric mean** | | | " + " | ".join(f"**{m:.2f}**, largest {max(r):.2f}" for m, r in zip(means, ratios)) + " |")


if __name__ == "__main__":
    main()
