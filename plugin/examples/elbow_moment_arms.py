# SPDX-License-Identifier: Apache-2.0
# Lengths and moment arms of the elbow's muscles over its motion, as a table and as a picture.
import subprocess
import sys

import numpy as np

import tautline

# A model, and the poses that we want: 91 angles of one coordinate, one row each.
model = tautline.read_osim(sys.argv[1] if len(sys.argv) > 1 else "models/elbow.osim")
angle = "elbow_flexion"
q = np.linspace(0.0, 2.2, 91)[:, None]

# One call solves all of them, in all threads of the machine.
study = tautline.Study(model)
results = study.solve(q, coordinates=[angle])
assert np.all(results.sound), results.explain(int(np.argmin(results.sound.min(axis=1))), study.paths[0])

lengths = results.length                # (91, muscles) [m]
arms = results.moment_arm[:, :, study.coordinates.index(angle)]  # the same [m]
for p, muscle in enumerate(study.paths):
    best = np.argmax(np.abs(arms[:, p]))
    print(f"{muscle}: {lengths[:, p].min():.4f} to {lengths[:, p].max():.4f} m long, "
          f"largest moment arm {1000 * arms[best, p]:.1f} mm at {np.degrees(q[best, 0]):.0f} degrees")

# The picture, by gnuplot.
table = "\n".join(" ".join(map(str, row)) for row in np.hstack([np.degrees(q), 1000 * arms]))
curves = ", ".join(f"$arms using 1:{p + 2} with lines title '{name}' noenhanced" for p, name in enumerate(study.paths))
script = f"""set terminal svg size 640, 400
set output 'elbow_moment_arms.svg'
set xlabel '{angle} [deg]' noenhanced
set ylabel 'moment arm [mm]'
$arms << end
{table}
end
plot {curves}
"""
subprocess.run(["gnuplot"], input=script, text=True, check=True)
print("picture: elbow_moment_arms.svg")
