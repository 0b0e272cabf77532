#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Muscles over bones, beside what stands for the bones in models: the triceps of arm26 over the humerus as it is and over
the model's cylinder, and the latissimus dorsi over the whole chest and over the fitted patch of latissimus.osim.

    python3 models/over_bones.py OPENSIM_MODELS GEOMETRY [--study triceps] [--out FOLDER] [--figures FOLDER]
        [--program build/bin/tautline]

The first folder has OpenSim's arm26.osim, the second its bones (arm_r_humerus.vtp, ribs.vtp); both are only read. What is
made (solids, models, motions, results, figures by gnuplot) goes to the output folder.
"""
import argparse
import math
import pathlib
import re
import subprocess


def run(*command):
    return subprocess.run([str(word) for word in command], check=True, capture_output=True, text=True).stdout


def write_motion(file, names, rows):
    """Columns of a motion: time [s], then coordinates [rad]."""
    lines = ["motion", "version=1", f"nRows={len(rows)}", f"nColumns={1 + len(names)}", "inDegrees=no", "endheader"]
    lines.append("\t".join(["time", *names]))
    lines += ["\t".join(f"{value:.15g}" for value in row) for row in rows]
    file.write_text("\n".join(lines) + "\n")


def read_table(file):
    """{name: column} of a storage file."""
    names, *rows = file.read_text().split("endheader\n")[1].strip().split("\n")
    columns = zip(*[[float(word) for word in row.split("\t")] for row in rows])
    return dict(zip(names.split("\t"), (list(column) for column in columns)))


def replace_wrap(model, kind, name, solid):
    """The text of a model with a solid in place of a wrap object."""
    element = f'<TautlineWrapMesh name="{name}"><solid_file>{solid.name}</solid_file></TautlineWrapMesh>'
    changed, count = re.subn(rf'<{kind} name="{name}">.*?</{kind}>', element, model, flags=re.S)
    if count != 1:
        raise SystemExit(f"{count} elements <{kind} name=\"{name}\"> in the model, not one")
    return changed


def solve(options, model, motion, muscles):
    """Tables of paths and of moment arms. Ends with a message if a path in a frame is no verified shortest one."""
    out = model.with_suffix("")
    run(options.program, "solve", model, "--motion", motion, "--muscles", muscles, "--out", out)
    return read_table(out / "paths.sto"), read_table(out / "moment_arms.sto")


def fit(options, mesh, solid, *arguments):
    text = run(options.program, "fit", options.geometry / mesh, "--bone", "--out", solid, *arguments)
    print(f"{mesh}: {re.search('off the mesh.*', text).group(0)}")


def calc_largest_jump(times, values, rates):
    """Of a curve against its rates: what the trapezoidal rule leaves of a step."""
    steps = range(len(times) - 1)
    return max(abs(values[k + 1] - values[k] - 0.5 * (times[k + 1] - times[k]) * (rates[k] + rates[k + 1])) for k in steps)


def plot(options, name, title, axis, rows, labels, panels):
    """Panels of curves over the first of the rows' columns. panels: (label of y, columns, from 2)."""
    file, data = options.figures / (name + ".svg"), options.out / (name + ".txt")
    data.write_text("\n".join(" ".join(f"{value:.10g}" for value in row) for row in rows) + "\n")
    script = [f"set terminal svg size 700,{260 * len(panels)} background 'white'", f"set output '{file}'",
              f"set multiplot layout {len(panels)},1 title '{title}'", "set grid", "set key bottom center", f"set xlabel '{axis}'"]
    for label, columns in panels:
        curves = ", ".join(f"'{data}' using 1:{column} with lines lw 2 title '{labels[column]}'" for column in columns)
        script += [f"set ylabel '{label}'", f"plot {curves}"]
    subprocess.run(["gnuplot"], input="\n".join(script) + "\n", text=True, check=True)


def study_triceps(options):
    out, solid = options.out, options.out / "humerus.solid"
    fit(options, "arm_r_humerus.vtp", solid, "--width", 0.002)
    source = (options.models / "arm26.osim").read_text()
    cylinder, bone = out / "arm26_cylinder.osim", out / "arm26_bone.osim"
    cylinder.write_text(source)
    bone.write_text(replace_wrap(source, "WrapCylinder", "TRI", solid))
    angles = [math.radians(2 * k) for k in range(66)]
    motion = out / "flexion.mot"
    write_motion(motion, ["r_elbow_flex"], [[0.01 * k, angle] for k, angle in enumerate(angles)])
    name, coordinate = "/forceset/TRIlong", "r_elbow_flex"
    rows = [[math.degrees(angle)] for angle in angles]
    for model in (cylinder, bone):
        paths, arms = solve(options, model, motion, "TRI*")
        arm = next(column for key, column in arms.items() if key.startswith(name + "|moment_arm.") and coordinate in key)
        contact = [sum(column[k] for key, column in paths.items() if key.startswith(name + "|contact.TRI") and
                       re.fullmatch(r"TRI(_\d+)?", key.split("contact.")[1])) for k in range(len(angles))]
        for row, *values in zip(rows, paths[name + "|length"], arm, contact):
            row += values
    print("flexion  length over cylinder, bone [mm]  moment arm [mm]    touches")
    for row in rows[::10]:
        print(f"{row[0]:5.0f}    {1e3 * row[1]:10.2f} {1e3 * row[4]:10.2f}       {1e3 * row[2]:8.2f} {1e3 * row[5]:8.2f}"
              f"   {row[3]:3.0f} {row[6]:3.0f}")
    scaled = [[row[0]] + [1e3 * row[k] for k in (1, 4, 2, 5)] for row in rows]
    plot(options, "arm26_triceps_over_bone", "Long head of the triceps, arm26", "elbow flexion [deg]", scaled,
         {2: "cylinder of the model", 3: "humerus", 4: "cylinder of the model", 5: "humerus"},
         [("length [mm]", (2, 3)), ("moment arm [mm]", (4, 5))])


def study_latissimus(options):
    out, solid = options.out, options.out / "chest.solid"
    fit(options, "ribs.vtp", solid, "--close", 0.2, "--width", 0.008)
    source = pathlib.Path(__file__).with_name("latissimus.osim").read_text()
    patch, chest = out / "latissimus_patch.osim", out / "latissimus_chest.osim"
    patch.write_text(source)
    chest.write_text(replace_wrap(source, "TautlineWrapPatch", "ribs", solid))
    times = [0.1 * k for k in range(51)]
    motion = out / "raising.mot"
    write_motion(motion, ["plane", "elevation"], [[t, math.pi / 20 * t, math.pi / 10 * t] for t in times])
    rows = [[t] for t in times]
    for model in (patch, chest):
        paths, _ = solve(options, model, motion, "latissimus*")
        names = [f"/forceset/latissimus_{i}|" for i in range(1, 11)]
        jump = max(calc_largest_jump(times, paths[name + "length"], paths[name + "rate"]) for name in names)
        print(f"{model.stem}: the rate explains each step of each length to {jump:.1e} m")
        for k, row in enumerate(rows):
            row += [sum(paths[name + quantity][k] for name in names) / len(names) for quantity in ("length", "rate")]
    print("time   mean length over patch, chest [mm]   mean rate [mm/s]")
    for row in rows[::10]:
        print(f"{row[0]:3.0f} s  {1e3 * row[1]:10.2f} {1e3 * row[3]:10.2f}          {1e3 * row[2]:8.3f} {1e3 * row[4]:8.3f}")
    scaled = [[row[0]] + [1e3 * row[k] for k in (1, 3, 2, 4)] for row in rows]
    plot(options, "latissimus_over_chest", "Latissimus dorsi, mean of ten paths", "time [s]", scaled,
         {2: "patch", 3: "whole chest", 4: "patch", 5: "whole chest"},
         [("length [mm]", (2, 3)), ("rate [mm/s]", (4, 5))])


STUDIES = {"triceps": study_triceps, "latissimus": study_latissimus}


def main():
    root = pathlib.Path(__file__).resolve().parent.parent
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("models", type=pathlib.Path, help="folder of arm26.osim")
    parser.add_argument("geometry", type=pathlib.Path, help="folder of the bones")
    parser.add_argument("--study", choices=STUDIES, action="append", help="only this one; repeatable")
    parser.add_argument("--out", type=pathlib.Path, default=root / "results" / "over_bones")
    parser.add_argument("--figures", type=pathlib.Path, help="folder of the figures (default: that of the results)")
    parser.add_argument("--program", type=pathlib.Path, default=root / "build" / "bin" / "tautline")
    options = parser.parse_args()
    options.figures = options.figures or options.out
    options.out.mkdir(parents=True, exist_ok=True)
    for study in options.study or STUDIES:
        STUDIES[study](options)


if __name__ == "__main__":
    main()
