# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) the pcl_flashreg authors

"""Several threads, signals, the end of Python, memory. No test asserts a speed."""

import concurrent.futures
import os
import signal
import subprocess
import sys
import threading
import time

import numpy as np
import pytest
from conftest import DATA, made_points, moved, same_result, some_pose

import pcl_flashreg

SOURCE = made_points()
TARGET = moved(SOURCE, some_pose())


def test_eight_threads_with_an_object_each(pair):
    def work(_):
        registration = pcl_flashreg.PairRegistration(1)
        return [registration.align(pair.source, pair.target, 0.05) for _ in range(2)]

    with concurrent.futures.ThreadPoolExecutor(8) as pool:
        for results in pool.map(work, range(8)):
            assert all(same_result(result, pair.result) for result in results)


def test_threads_share_scans(pair):
    index = pcl_flashreg.PairRegistration().make_index(pair.target_scan)

    def work(target):
        return pcl_flashreg.align(pair.source_scan, target, num_threads=1)

    with concurrent.futures.ThreadPoolExecutor(8) as pool:
        for result in pool.map(work, [pair.target_scan, index] * 4):
            assert same_result(result, pair.result)


def computes(pair, registration, started):
    started.set()
    try:
        for _ in range(20):
            registration.align(pair.source, pair.target, 0.05)
    except RuntimeError as error:
        return error


def test_others_go_on_during_a_call(pair):
    """Within one call this thread gets the lock many times, which it would not if the call
    kept it."""
    calls = []
    over = threading.Event()

    def work():
        result = pcl_flashreg.align(pair.source, pair.target, 0.05, num_threads=1)
        calls.append(result)
        over.set()

    thread = threading.Thread(target=work)
    thread.start()
    rounds = 0
    while not over.is_set():
        time.sleep(0.001)
        rounds += 1
    thread.join()
    assert calls and rounds >= 3


def test_one_object_in_two_threads_is_an_error(pair):
    registration = pcl_flashreg.PairRegistration(1)
    started = threading.Event()
    with concurrent.futures.ThreadPoolExecutor(1) as pool:
        other = pool.submit(computes, pair, registration, started)
        started.wait()
        errors = []
        while not other.done():
            try:
                registration.estimate_pose(SOURCE, TARGET, 0.05)
            except RuntimeError as error:
                errors.append(error)
        errors += filter(None, [other.result()])
    assert errors
    assert "this PairRegistration is in a call of another thread" in str(errors[0])
    # It is as good as before.
    result = registration.align(pair.source, pair.target, 0.05)
    assert same_result(result, pair.result)


class Interrupt(Exception):
    pass


@pytest.fixture
def interrupts():
    """A signal whose handler raises an exception."""

    def handle(number, frame):
        raise Interrupt

    before = signal.signal(signal.SIGALRM, handle)
    yield
    signal.setitimer(signal.ITIMER_REAL, 0)
    signal.signal(signal.SIGALRM, before)


def test_a_signal_ends_a_call(pair, interrupts):
    registration = pcl_flashreg.PairRegistration(1)
    for delay in (0.001, 0.01, 0.03, 0.06):
        signal.setitimer(signal.ITIMER_REAL, delay)
        with pytest.raises(Interrupt):
            while True:
                registration.align(pair.source, pair.target, 0.05)
        # The call is over, whatever is left of its time: its object may be used at once.
        result = registration.align(pair.source, pair.target, 0.05)
        assert same_result(result, pair.result)


def test_a_signal_ends_a_map(pair, interrupts):
    scans = [pair.source_scan, pair.target_scan] * 20
    registration = pcl_flashreg.MultiviewRegistration()
    steps = []

    def progress(done, all):
        if not steps:
            signal.setitimer(signal.ITIMER_REAL, 0.01)
        steps.append(done)

    with pytest.raises(Interrupt):
        registration.align(scans, progress=progress)
    assert 0 < len(steps) < 400
    count = len(steps)
    time.sleep(0.2)
    assert len(steps) == count  # nothing goes on


def test_a_handler_that_raises_nothing_ends_nothing(pair):
    seen = []
    before = signal.signal(signal.SIGALRM, lambda *_: seen.append(time.monotonic()))
    try:
        signal.setitimer(signal.ITIMER_REAL, 0.02)
        result = pcl_flashreg.align(pair.source, pair.target, 0.05, num_threads=1)
        assert same_result(result, pair.result)
    finally:
        signal.setitimer(signal.ITIMER_REAL, 0)
        signal.signal(signal.SIGALRM, before)
    deadline = time.monotonic() + 60
    while not seen and time.monotonic() < deadline:
        time.sleep(0.01)
    assert len(seen) <= 1


def run_python(program):
    paths = [str(p) for p in sys.path if p]
    environment = dict(os.environ, PYTHONPATH=os.pathsep.join(paths))
    return subprocess.Popen(
        [sys.executable, "-c", program],
        env=environment,
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
    )


PREPARE = f"""
import pcl_flashreg, threading, time, os
source = pcl_flashreg.read_cloud({str(DATA / "indoor" / "source.pcd")!r})
target = pcl_flashreg.read_cloud({str(DATA / "indoor" / "target.pcd")!r})
def forever():
    registration = pcl_flashreg.PairRegistration(1)
    print("begins", flush=True)
    while True:
        registration.align(source, target, 0.05)
"""


def test_control_c():
    process = run_python(PREPARE + "forever()")
    assert process.stdout.readline() == "begins\n"
    time.sleep(0.2)
    process.send_signal(signal.SIGINT)
    _, errors = process.communicate(timeout=120)
    assert process.returncode == -signal.SIGINT, errors
    assert errors.rstrip().endswith("KeyboardInterrupt")


def test_python_ends_while_other_threads_compute():
    program = PREPARE + (
        "for _ in range(3): threading.Thread(target=forever, daemon=True).start()\n"
        "time.sleep(0.3)\n"
    )
    for _ in range(3):
        process = run_python(program)
        _, errors = process.communicate(timeout=120)
        assert process.returncode == 0, errors
        assert errors == ""


def test_fork():
    program = PREPARE + (
        "registration = pcl_flashreg.PairRegistration(2)\n"
        "first = registration.align(source, target, 0.05)\n"
        "threading.Thread(target=forever, daemon=True).start()\n"
        "child = os.fork()\n"
        "again = registration.align(source, target, 0.05)\n"
        "assert (first.T_target_source == again.T_target_source).all()\n"
        "if child: assert os.waitpid(child, 0)[1] == 0\n"
    )
    process = run_python(program)
    _, errors = process.communicate(timeout=120)
    assert process.returncode == 0, errors


def resident_bytes():
    with open("/proc/self/statm") as file:
        return int(file.read().split()[1]) * os.sysconf("SC_PAGE_SIZE")


@pytest.mark.skipif(not os.path.exists("/proc/self/statm"), reason="no /proc")
def test_ten_thousand_calls_take_no_memory():
    registration = pcl_flashreg.PairRegistration(1)
    source, target = SOURCE[:40], np.asfortranarray(TARGET[:40])

    def call(times):
        for i in range(times):
            result = registration.estimate_pose(source, target, 0.05)
            assert result.inliers[0] == 0 and result.hypotheses
            with pytest.raises(ValueError):
                registration.estimate_pose(source[:, :2], target)

    call(1000)
    before = resident_bytes()
    call(10_000)
    # An array of the 40 points that stayed behind in each call would be ten times this.
    assert resident_bytes() - before < 1 << 20


@pytest.mark.skipif(not os.path.exists("/proc/self/statm"), reason="no /proc")
def test_scans_give_their_memory_back(pair):
    registration = pcl_flashreg.PairRegistration(1)

    def call(times):
        for _ in range(times):
            scan = registration.make_scan(pair.source, 0.05)
            assert len(scan.points) == len(scan)

    call(5)
    before = resident_bytes()
    call(40)
    # A scan has some two megabytes.
    assert resident_bytes() - before < 20 << 20
