"""Keeps a disturbed mechanism on its motion by time-varying LQR.

The gains come from `ltv.npz` alone. They act as signals in a copy of the scene, which the program simulates.

    python3 time_varying_lqr.py HOLONOM SCENE.json FOLDER TIMES NAME=VALUE

TIMES are those of `linearize --along`, as in 0..2:101. The parameter NAME disturbs the start. Each input of the scene is
an applied torque, and the angles of the bodies of a plane scene tell its state. The script prints how far the end is off the nominal motion, without and with the controller.
"""

import csv
import json
import pathlib
import subprocess
import sys

import numpy

# Weights: of displacements z as of velocities y that would undo them in 1/RATE s, and of the torques.
RATE = 5.0
EFFORT = 1e-4


def gains(model):
    """u = -K x: the backward recursion of Riccati over the intervals, torques held."""
    phi, b, t = model["Phi"], model["B"], model["t"]
    half = phi.shape[1] // 2
    weight = numpy.diag([RATE**2] * half + [1.0] * half)
    p = weight
    found = []
    for k in reversed(range(len(phi))):
        h = t[k + 1] - t[k]
        gamma = h * (phi[k] @ b[k] + b[k + 1]) / 2
        effort = EFFORT * h * numpy.eye(gamma.shape[1]) + gamma.T @ p @ gamma
        found.append(numpy.linalg.solve(effort, gamma.T @ p @ phi[k]))
        p = h * weight + phi[k].T @ p @ (phi[k] - gamma @ found[-1])
    return [*reversed(found), found[0]]


def controlled(scene, model):
    """The scene with u = -K x added to its torques: gains and nominal angles are signals of time.

    Angles and their rates are measured. Their changes are R z, and R y + T z: both are solved for x = (z, y).
    """
    names = model["q_names"].tolist()
    rows = [j for j, name in enumerate(names) if name.endswith(".angle")]
    times = model["t"].tolist()
    by_time = []
    for k, gain in enumerate(gains(model)):
        left = numpy.linalg.pinv(model["R"][k][rows])
        tilt = model["T"][k][rows]
        by_time.append(gain @ numpy.block([[left, numpy.zeros_like(left)], [-left @ tilt @ left, left]]))
    by_time = numpy.array(by_time)
    signals = []

    def signal(name, values):
        signals.append({"name": name, "points": [list(point) for point in zip(times, values.tolist())]})
        return f"{name}(t)"

    angles = [f"({names[j]} - {signal(f'q{j}', model['q'][:, j])})" for j in rows]
    rates = [f"({names[j]}' - {signal(f'v{j}', model['v'][:, j])})" for j in rows]
    forces = {force["name"]: force for force in scene["forces"]}
    for i, entry in enumerate(scene["inputs"]):
        force = forces[entry["force"]]
        terms = [f"{signal(f'k{i}_{j}', by_time[:, i, j])}*{x}" for j, x in enumerate(angles + rates)]
        force["torque"] = f"{force['torque']} - ({' + '.join(terms)})"
    return {**scene, "signals": scene.get("signals", []) + signals, "inputs": []}


def end(program, scene, folder, disturbance, names):
    """The coordinates at the end of a run."""
    subprocess.run([program, "simulate", scene, "--set", disturbance, "-o", folder, "--figures", "none", "--quiet"], check=True)
    with open(folder / "trajectory.csv", newline="") as file:
        *_, last = csv.DictReader(file)
    return numpy.array([float(last[name]) for name in names])


def main(program, path, folder, times, disturbance):
    folder = pathlib.Path(folder)
    subprocess.run([program, "linearize", path, "--along", times, "-o", folder / "model", "--quiet"], check=True)
    model = numpy.load(folder / "model" / "ltv.npz")
    scene = json.loads(pathlib.Path(path).read_text())
    (folder / "controlled.json").write_text(json.dumps(controlled(scene, model), indent=1))
    names = model["q_names"].tolist()
    goal = model["q"][-1]
    free = end(program, path, folder / "free", disturbance, names)
    kept = end(program, folder / "controlled.json", folder / "kept", disturbance, names)
    print(f"{numpy.abs(free - goal).max():.2e} without, {numpy.abs(kept - goal).max():.2e} with the controller")


if __name__ == "__main__":
    main(*sys.argv[1:])
