# SPDX-License-Identifier: BSD-3-Clause
"""Peer for LIGGGHTS text dumps: numpy.loadtxt with usecols + scipy. `peer_text.py FOLDER OUT`"""

import numpy as np

import products


def read(path):
    with open(path) as file:
        for header_lines, line in enumerate(file, start=1):
            if line.startswith("ITEM: ATOMS"):
                names = line.split()[2:]
                break
    columns = [names.index(name) for name in ("x", "z", "vx", "vz", "radius")]
    return np.loadtxt(path, skiprows=header_lines, usecols=columns, unpack=True)


products.main(read)
