#!/usr/bin/env python3
"""How much faster the GPU path starts once Mesa has its shaders in its cache.

Runs `rigel render` twice with MESA_SHADER_CACHE_DIR and Rigel's own cache in fresh, empty folders and compares the time
from the making of the device to the end of the first frame (load_ms + first_frame_ms of --json): pipelines and their
first draws are in it, reading the scene and fitting rigs are not. Exit code 1 if the second start is less than five
times as fast, as promised. Usage:
    tools/study/gpu_start_up.py [--rigel build/release/rigel] [--runs N] [SCENE ARGUMENTS...]
"""
import argparse
import json
import os
import statistics
import subprocess
import sys
import tempfile

PROMISED = 5
SCENE = ["sample:street", "--rig", "auto", "--total-error", "0.03"]
SMALL = ["--size", "160x90", "--supersampling", "1", "--quiet", "--json"]


def start(rigel, scene, cache):
    environment = dict(os.environ, MESA_SHADER_CACHE_DIR=os.path.join(cache, "mesa"),
                       XDG_CACHE_HOME=os.path.join(cache, "user"))
    environment.pop("MESA_SHADER_CACHE_DISABLE", None)
    command = [rigel, "render", *scene, *SMALL, "--out", os.path.join(cache, "frame.exr")]
    done = subprocess.run(command, capture_output=True, text=True, env=environment)
    if done.returncode != 0:
        sys.exit(done.stderr.strip())
    return json.loads(done.stdout)


def milliseconds(figures):
    return figures["load_ms"] + figures["first_frame_ms"]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--rigel", default="build/release/rigel")
    parser.add_argument("--runs", type=int, default=3, help="pairs of starts; the median ratio counts")
    parser.add_argument("scene", nargs=argparse.REMAINDER, help="scene and arguments of `rigel render`")
    arguments = parser.parse_args()
    scene = arguments.scene or SCENE
    ratios = []
    print("rigel render " + " ".join(scene))
    for _ in range(arguments.runs):
        with tempfile.TemporaryDirectory() as cache:
            first, second = (start(arguments.rigel, scene, cache) for _ in range(2))
        ratios.append(milliseconds(first) / milliseconds(second))
        print(f"{first['device']}, {first['pipelines']} pipelines: {milliseconds(first):.0f} ms to the first frame, "
              f"{milliseconds(second):.0f} ms the second time: {ratios[-1]:.1f} times as fast", flush=True)
    ratio = statistics.median(ratios)
    print(f"median {ratio:.1f}")
    return 0 if ratio >= PROMISED else 1


if __name__ == "__main__":
    sys.exit(main())
