#!/usr/bin/env python3
"""How far `auto` is from the front of everything that `rigel pareto` measures, scene by scene, as a Markdown table.

A point is judged by the error that it aims at (spatial for --error, total for --total-error) and by the cost model,
which is what `auto` goes by: the least change of either that takes it to the front. Usage:
    tools/study/auto_front.py [--rigel build/release/rigel] [--limit 1.1] [SCENE...]
Exit code 1 where a point is farther than the limit.
"""
import argparse
import json
import math
import subprocess
import sys
import tempfile


def measure(rigel, scene):
    with tempfile.TemporaryDirectory() as out:
        command = [rigel, "pareto", scene, "--bands", "3", "--device", "none", "--quiet", "--json", "--out", out]
        done = subprocess.run(command, capture_output=True, text=True)
        if done.returncode != 0:
            sys.exit(f"{' '.join(command)}: {done.stderr.strip()}")
        return json.loads(done.stdout)


def nearest(distances, cost, error):
    for d in distances:
        if d["cost"] == cost and d["error"] == error:
            return min((ratio for ratio in (d["cost_ratio"], d["error_ratio"]) if ratio is not None), default=math.inf)
    return None


def rows(document):
    for entry in document["objects"]:
        for found in entry["auto"]:
            point = entry["points"][found["point"]]
            if point["spec"] != "auto" or point["near"] != "auto":
                continue
            error = "total_rms" if point["target"].startswith("--total") else "spatial_rms"
            ratios = [nearest(found["distances"], cost, error) for cost in ("modelled_ns_per_point", "frame_us")]
            yield entry["name"], point["target"], point[error], *ratios


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--rigel", default="build/release/rigel")
    parser.add_argument("--limit", type=float, default=1.1)
    parser.add_argument("scenes", nargs="*", metavar="SCENE")
    arguments = parser.parse_args()
    scenes = arguments.scenes
    if not scenes:
        listed = subprocess.run([arguments.rigel, "sample", "--list", "--json"], capture_output=True, text=True, check=True)
        scenes = ["sample:" + sample["name"] for sample in json.loads(listed.stdout)["samples"]]

    beyond = 0
    print("| scene | targets | on the front | farthest, cost model | at | farthest with fit, 10,000 points |")
    print("|---|---|---|---|---|---|")
    for scene in scenes:
        found = list(rows(measure(arguments.rigel, scene)))
        beyond += sum(model > arguments.limit for _, _, _, model, _ in found)
        name, target, _, model, _ = max(found, key=lambda row: row[3])
        on = sum(row[3] <= 1.0005 for row in found)
        clock = max(row[4] for row in found)
        print(f"| `{scene}` | {len(found)} | {on} | {100 * (model - 1):.1f} % | `{target}` ({name}) | {100 * (clock - 1):.0f} % |")
    if beyond:
        print(f"{beyond} points are farther than {100 * (arguments.limit - 1):.0f} %", file=sys.stderr)
    return 1 if beyond else 0


if __name__ == "__main__":
    sys.exit(main())
