"""An elastic block pressed onto a rigid plane, by the augmented Lagrangian method as on the page
"Finite elements". Requires NumPy. Units: N, mm; plane strain, 1 mm thick."""

import numpy as np

E, nu, h, nx, ny = 210e3, 0.3, 2.5, 16, 8  # N/mm², -, edge of an element in mm, elements
push, tol = 0.02, 1e-12  # mm: displacement of the upper edge, admissible residual

# Stiffness matrix of a square element with four nodes, by Gauss's rule with 2 × 2 points.
D = E / (1 + nu) / (1 - 2 * nu) * np.array([[1 - nu, nu, 0], [nu, 1 - nu, 0], [0, 0, 0.5 - nu]])
corners, Ke = np.array([[-1, -1], [1, -1], [1, 1], [-1, 1]]), np.zeros((8, 8))
for a, b in corners / np.sqrt(3):
    dx, dy = np.array([[x * (1 + y * b), y * (1 + x * a)] for x, y in corners]).T / (2 * h)
    B = np.zeros((3, 8))
    B[0, 0::2], B[1, 1::2], B[2, 0::2], B[2, 1::2] = dx, dy, dy, dx
    Ke += B.T @ D @ B * h**2 / 4

# The upper edge is moved down; each node of the lower edge, which is slightly curved, may touch the plane.
node = np.arange((nx + 1) * (ny + 1)).reshape(ny + 1, nx + 1)
K = np.zeros((2 * node.size, 2 * node.size))
for i, j in np.ndindex(ny, nx):
    dofs = (2 * node[[i, i, i + 1, i + 1], [j, j + 1, j + 1, j]][:, None] + [0, 1]).ravel()
    K[np.ix_(dofs, dofs)] += Ke
moved, free = np.zeros(2 * node.size), 2 * (nx + 1) * ny
moved[2 * node[-1] + 1] = -push
K, f = K[:free, :free], -(K @ moved)[:free]
G, gap = np.zeros((nx + 1, free)), 1e-4 * (node[0] * h - nx * h / 2) ** 2
G[range(nx + 1), 2 * node[0] + 1] = -1.0  # displacements towards the plane

eps = 10 * np.abs(G @ K @ G.T).sum(axis=1).max()  # ten times the largest row sum, at the contacts
s_min = np.linalg.eigvalsh(G @ np.linalg.solve(K, G.T))[0]  # only for the bound in the log
print(f"1/s_min = {1 / s_min:.4g} N/mm, eps = {eps:.4g} N/mm")
print(" k  |r| in mm  bound      contacts  solves")

u, lam, first = np.zeros(free), np.zeros(nx + 1), None


def forces(u):  # λ + ε p
    return lam + eps * (G @ u - gap)


def energy(u):
    return u @ (K @ u) / 2 - f @ u + (np.maximum(forces(u), 0) ** 2).sum() / (2 * eps)


for k in range(100):  # augmentations
    solves, active = 0, None
    while active is None or (active != (forces(u) > 0)).any():  # inner: Newton's method with a line search
        active, t = forces(u) > 0, 1.0
        A = G[active]
        slope = K @ u - f + A.T @ forces(u)[active]
        step = -np.linalg.solve(K + eps * A.T @ A, slope)
        # A step to the same active set is exact, and the difference of the energies may be below rounding.
        while t > 1e-6 and (active != (forces(u + t * step) > 0)).any() \
                and energy(u + t * step) > energy(u) + 0.1 * t * (slope @ step):
            t /= 2
        u, solves = u + t * step, solves + 1
    new = np.maximum(forces(u), 0)
    r, old, lam = np.linalg.norm(new - lam) / eps, r if k else np.inf, new
    first = first or r
    print(f"{k:2}  {r:.3e}  {first / (1 + eps * s_min) ** k:.3e}  {active.sum():8}  {solves:6}")
    if r < tol or r >= old:  # converged, or stagnated
        break
print(f"contact force {lam.sum():.6g} N, out of balance by {np.abs(K @ u + G.T @ lam - f).max():.0e} N")
