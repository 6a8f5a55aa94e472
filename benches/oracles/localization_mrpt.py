"""MRPT's pf-localization and `periplus localize` on MRPT's own demo: the same scans, the same map.

usage: localization_mrpt.py PERIPLUS OUT

Needs `pf-localization`, `observations2map` and the demo's files: `sudo apt install mrpt-apps mrpt-common`
(the data set lies in /usr/share/mrpt). Nothing but Python's own library is used. Prints a table: CPU of
both programs, the least of three turns each, taken in turn.
"""

import gzip
import json
import math
import pathlib
import re
import resource
import shutil
import struct
import subprocess
import sys

SHARE = pathlib.Path("/usr/share/mrpt")
RAWLOG = SHARE / "datasets/localization_demo.rawlog"
MAP = SHARE / "datasets/localization_demo.simplemap.gz"
CONFIG = SHARE / "config_files/pf-localization/localization_demo.ini"
TURNS = 3
INSTALL = "install it with `sudo apt install mrpt-apps mrpt-common`"


def skip(why):
    print(f"SKIPPED: {why}: MRPT's pf-localization is not measured; {INSTALL}")
    sys.exit(0)


def scans(rawlog):
    """Motions and scans of a log of actions and frames, in order.

    Objects stand one after the other: a byte with the length of the name and a bit that says so, the name,
    a version, the content. Only two kinds are of interest, and their content is short.
    """
    data = gzip.open(rawlog).read() if rawlog.read_bytes()[:2] == b"\x1f\x8b" else rawlog.read_bytes()
    x, y, yaw = 0.0, 0.0, 0.0
    found = []
    for each in re.finditer(rb"\x96CActionRobotMovement2D|\x97CObservation2DRangeScan", data):
        if each.group().endswith(b"2D"):
            # The motion is the first pose of the action.
            at = data.index(b"\x87CPose2D", each.end()) + 9
            dx, dy, turn = struct.unpack_from("<3d", data, at)
            x += dx * math.cos(yaw) - dy * math.sin(yaw)
            y += dx * math.sin(yaw) + dy * math.cos(yaw)
            yaw += turn
        else:
            aperture, is_left, most = struct.unpack_from("<f?f", data, each.end() + 1)
            at = data.index(b"\x87CPose3D", each.end()) + 9
            # Where the scanner is, and four numbers of how it is turned.
            place = struct.unpack_from("<7d", data, at)
            at += 7 * 8 + 1
            (count,) = struct.unpack_from("<I", data, at)
            ranges = struct.unpack_from(f"<{count}f", data, at + 4)
            found.append(((x, y, yaw), aperture, is_left, most, place, ranges))
    return found


def write_log(out):
    """The same as a log of CARMEN: 361 beams are from -90 to 90 degrees, both included."""
    lines = []
    for index, ((x, y, yaw), aperture, is_left, _, place, ranges) in enumerate(scans(RAWLOG)):
        if abs(aperture - math.pi) > 1e-3 or len(ranges) % 2 == 0:
            sys.exit("the demo's scans are not of half a circle with an odd number of beams")
        if not is_left:
            ranges = ranges[::-1]
        if index == 0:
            lines.append(f"PARAM robot_frontlaser_offset {place[0]:.3f}")
        values = " ".join(f"{it:.3f}" for it in ranges)
        pose = f"{x:.6f} {y:.6f} {yaw:.6f}"
        lines.append(f"FLASER {len(ranges)} {values} {pose} {pose} {0.25 * index:.6f} mrpt {0.25 * index:.6f}")
    path = out / "demo.clf"
    path.write_text("\n".join(lines) + "\n")
    return path, len(lines) - 1


def write_map(out):
    """The map that MRPT makes of the demo's observations, by its own options."""
    section = "MappingApplication"
    text = CONFIG.read_text()
    begin = text.index("[MetricMap]")
    (out / "map.ini").write_text(text[begin:].replace("[MetricMap", f"[{section}"))
    run(["observations2map", "map.ini", str(MAP), "demo"], out, b"\n")
    (picture,) = out.glob("demo_*OccupancyGridMap2D_00.png")
    (limits,) = out.glob("demo_*OccupancyGridMap2D_00_limits.txt")
    numbers = [float(it) for it in limits.read_text().splitlines()[-1].split()]
    resolution = re.search(r"^resolution\s*=\s*([0-9.]+)", text, re.M).group(1)
    path = out / "map.yaml"
    path.write_text(
        f"image: {picture.name}\nresolution: {resolution}\norigin: [{numbers[0]:.6f}, {numbers[2]:.6f}, 0]\n"
        "negate: 0\noccupied_thresh: 0.65\nfree_thresh: 0.25\n"
    )
    return path


def run(command, folder, told=b""):
    """Seconds of CPU, and what was said."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    done = subprocess.run(command, cwd=folder, input=told, capture_output=True, timeout=300)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    if done.returncode != 0:
        sys.exit(f"{command[0]} failed:\n{done.stdout[-500:]}{done.stderr[-500:]}")
    return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime


def demo(out):
    """The demo's settings, without a window and pictures."""
    text = CONFIG.read_text().replace("../../datasets", str(SHARE / "datasets"))
    for name, value in [("SHOW_PROGRESS_3D_REAL_TIME", "false"), ("3DSceneFrequency", "1000000"), ("logOutput_dir", "")]:
        text = re.sub(rf"^{name}\s*=.*$", f"{name}={value}", text, flags=re.M)
    (out / "demo.ini").write_text(text)


def main():
    periplus, out = pathlib.Path(sys.argv[1]).resolve(), pathlib.Path(sys.argv[2]).resolve()
    for program in ["pf-localization", "observations2map"]:
        if not shutil.which(program):
            skip(f"there is no `{program}`")
    for path in [RAWLOG, MAP, CONFIG]:
        if not path.exists():
            skip(f"there is no {path}")
    out.mkdir(parents=True, exist_ok=True)
    log, count = write_log(out)
    world = write_map(out)
    demo(out)
    ours = [str(periplus), "localize", str(log), "--map", str(world), "--out", str(out / "periplus"), "--quiet"]
    turns = [(run(["pf-localization", "demo.ini"], out), run(ours, out)) for _ in range(TURNS)]
    theirs, mine = (min(it[who] for it in turns) for who in (0, 1))
    report = json.loads((out / "periplus/report.json").read_text())
    print(f"| MRPT's demo, {count} scans | start | CPU s, least of {TURNS} | share |")
    print("|---|---|---|---|")
    print(f"| `pf-localization` | told: within 20 x 10 m | {theirs:.2f} | 1 |")
    print(f"| `periplus localize` | anywhere | {mine:.2f} | {mine / theirs:.2f} |")
    settled, states = report["settled_after_m"], report["scans_in_state"]
    print(f"\nPeriplus knew where it was after {settled} m; scans in each state: {states}")


main()
