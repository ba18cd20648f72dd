"""Evaluate curves that `batten inspect` prints, by their float polygons alone."""

import numpy as np
from scipy.interpolate import BSpline


def in_space(points):
    """Give points in the plane a third coordinate 0."""
    points = np.asarray(points, dtype=float)
    return np.pad(points, ((0, 0), (0, 3 - points.shape[1])))


def evaluated(curve):
    """Return the curve as a function of its parameter."""
    degree = curve["degree"]
    vertices = in_space(curve["float"])
    weights = np.asarray(curve["weights"] or np.ones(len(vertices)), dtype=float)
    homogeneous = np.column_stack([vertices * weights[:, None], weights])
    if curve["periodic"]:
        homogeneous = np.concatenate([homogeneous, homogeneous[:degree]])
    knots = np.arange(len(homogeneous) + degree + 1, dtype=float) - degree
    spline = BSpline(knots, homogeneous, degree)

    def point(u):
        values = spline(u)
        return values[..., :3] / values[..., 3:]

    return point


def curve_points(curve, samples):
    """Evaluate a curve at so many even parameters."""
    return evaluated(curve)(np.linspace(*curve["domain"], samples))
