# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) the pcl_flashreg authors
"""PCD files with the fields x y z, for the scripts beside this one."""

import numpy as np


def decompress(data, size):
    """LZF, as PCD's binary_compressed has it."""
    out = bytearray()
    i = 0
    while i < len(data):
        control = data[i]
        i += 1
        if control < 32:
            out += data[i : i + control + 1]
            i += control + 1
            continue
        length = control >> 5
        if length == 7:
            length += data[i]
            i += 1
        start = len(out) - ((control & 31) << 8) - data[i] - 1
        i += 1
        for k in range(length + 2):
            out.append(out[start + k])
    if len(out) != size:
        raise ValueError("damaged")
    return bytes(out)


def read_pcd(path):
    """Points of a file with the fields x y z of four bytes each, N x 3."""
    with open(path, "rb") as file:
        data = file.read()
    header = {}
    at = 0
    while "DATA" not in header:
        end = data.index(b"\n", at)
        words = data[at:end].decode().split()
        header[words[0]] = words[1:]
        at = end + 1
    count = int(header["POINTS"][0])
    if header["FIELDS"] != ["x", "y", "z"] or header["SIZE"] != ["4"] * 3:
        raise ValueError(path + ": expected x y z of four bytes each")
    if header["DATA"] == ["binary"]:
        return np.frombuffer(data, "<f4", 3 * count, at).reshape(-1, 3)
    if header["DATA"] != ["binary_compressed"]:
        raise ValueError(path + ": expected binary or binary_compressed data")
    packed, size = np.frombuffer(data, "<u4", 2, at)
    body = decompress(data[at + 8 : at + 8 + packed], size)
    return np.frombuffer(body, "<f4").reshape(3, -1).T


def write_pcd(path, points, viewpoint="0 0 0 1 0 0 0"):
    header = (
        "# .PCD v0.7\nVERSION 0.7\nFIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\n"
        "WIDTH %d\nHEIGHT 1\nVIEWPOINT %s\nPOINTS %d\nDATA binary\n"
    )
    with open(path, "wb") as file:
        file.write((header % (len(points), viewpoint, len(points))).encode())
        file.write(np.ascontiguousarray(points, "<f4").tobytes())
