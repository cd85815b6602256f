"""Tables 6.1 and 6.2 of Faure 2014: a cube of 1000 hexahedra pulled for 0.9 s."""

from __future__ import annotations

# By density [kg/m3] and Young's modulus [Pa].
# Faure 2014, table 6.1: step [s] -> (seconds, ms per step), None where "not stable"; by pair.
PAPER_EXPLICIT: dict[tuple[float, float], dict[float, tuple[float, float] | None]] = {
    (1e3, 1e5): {1e-4: None, 5e-5: (199, 11.056), 4e-5: (244, 10.844), 2e-5: (480, 10.667)},
    (1e4, 1e5): {1e-3: None, 5e-4: (21.3, 11.833), 4e-4: (25.3, 11.244), 2e-4: (50, 11.111)},
    (1e3, 1e4): {1e-4: None, 5e-5: (20, 1.111), 4e-5: (25.8, 1.147), 2e-5: (52, 1.156)},
    (1e4, 1e4): {1e-3: None, 5e-4: (2.8, 1.556), 4e-4: (3.6, 1.600), 2e-4: (6.5, 1.444)},
}
# Table 6.2: step [s] -> (seconds, ms per step).
PAPER_IMPLICIT: dict[tuple[float, float], dict[float, tuple[float, float]]] = {
    (1e3, 1e5): {
        0.5: (2.0, 667),
        0.4: (2.1, 525),
        0.3: (2.3, 575),
        0.2: (2.5, 500),
        0.1: (3.8, 422),
    },
    (1e4, 1e5): {
        0.5: (1.9, 633),
        0.4: (2.0, 500),
        0.3: (2.1, 525),
        0.2: (2.1, 420),
        0.1: (2.2, 244),
    },
    (1e3, 1e4): {
        0.5: (1.4, 467),
        0.4: (1.5, 375),
        0.3: (1.6, 400),
        0.2: (1.8, 360),
        0.1: (1.9, 211),
    },
    (1e4, 1e4): {
        0.5: (1.0, 333),
        0.4: (1.1, 275),
        0.3: (1.2, 300),
        0.2: (1.4, 280),
        0.1: (1.6, 178),
    },
}
