"""Runs the tests of cocotb on each design, and prints a table with a row for each test. A failed test is an error."""

import sys
from pathlib import Path
from typing import NamedTuple
from xml.etree import ElementTree

from cocotb_tools.runner import get_runner

HERE = Path(__file__).resolve().parent


class Design(NamedTuple):
    """A core behind a link, the tests to run, and the module with them; no tests stand for all."""

    name: str
    points: int
    contexts: int
    ring: int
    beat_bits: int
    tests: tuple[str, ...] = ()
    module: str = "test_stream"
    top: str = "incircle_stream_top"
    board: tuple[str, ...] = ()


# The tests that depend on the width of a beat.
WIDTH = (
    "registers_and_slverr",
    "identity",
    "meshes_under_random_stalls",
    "beat_with_a_hole",
    "stream_of_the_wrong_width",
    "host_that_does_not_read",
)
# Icarus takes seconds for the reset of `small` alone, so `small` gets the tests that need its size.
DESIGNS = [
    Design("tiny", 8, 2, 6, 64),
    Design("wide", 64, 4, 8, 128, WIDTH),
    Design("small", 1024, 16, 32, 64, ("registers_and_slverr", "meshes_under_random_stalls", "batch_side_by_side")),
    Design("network", 8, 2, 6, 0, (), "test_network", "network_board", ("network_board.v",)),
]


def run(design: Design, verilog: Path, out: Path) -> int:
    """Builds and tests a design, prints its rows, and returns the number of tests that failed or did not run."""
    runner = get_runner("icarus")
    runner.build(
        sources=[verilog / f"{design.name}.v", *(HERE / file for file in design.board)],
        hdl_toplevel=design.top,
        build_dir=out / design.name,
        build_args=["-g2005"],
        timescale=("1ns", "1ps"),
        always=True,
        log_file=out / f"{design.name}-build.log",
    )
    results = runner.test(
        test_module=design.module,
        hdl_toplevel=design.top,
        build_dir=out / design.name,
        test_dir=out / design.name,
        testcase=list(design.tests) or None,
        extra_env={
            "INCIRCLE_CORE": f"{design.points} {design.contexts} {design.ring} {design.beat_bits}",
            "COCOTB_LOG_LEVEL": "WARNING",
            # cocotbext-axi and cocotbext-eth 0.1.28 use names that cocotb 2.1 has but will drop.
            "PYTHONWARNINGS": "ignore::DeprecationWarning",
            "COCOTB_RANDOM_SEED": "1",
        },
        timescale=("1ns", "1ps"),
        log_file=out / f"{design.name}-test.log",
    )
    failed = 0
    cases = [case for case in ElementTree.parse(results).iter("testcase") if case.find("skipped") is None]
    for case in cases:
        is_failed = case.find("failure") is not None or case.find("error") is not None
        failed += is_failed
        found = case.find("properties/property[@name='sim_time_duration']")
        simulated = float(found.get("value", 0)) / 1000 if found is not None else 0
        verdict = "FAILED" if is_failed else "passed"
        seconds = float(case.get("time", 0))
        print(f"| {design.name} | {case.get('name')} | {verdict} | {simulated:.0f} | {seconds:.0f} |")
    missing = sorted(set(design.tests) - {case.get("name") for case in cases})
    for name in missing:
        print(f"| {design.name} | {name} | DID NOT RUN | | |")
    sys.stdout.flush()
    return failed + len(missing) if cases else 1


def main(verilog: Path, out: Path) -> int:
    """Tests all designs, whose Verilog is in one folder, and returns the exit code."""
    sys.path.insert(0, str(HERE))
    print("| design | test | result | simulated, µs | seconds |\n|---|---|---|---:|---:|", flush=True)
    failed = sum(run(design, verilog, out) for design in DESIGNS)
    if failed:
        print(f"{failed} tests failed: the logs are in {out}", file=sys.stderr)
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main(Path(sys.argv[1]).resolve(), Path(sys.argv[2]).resolve()))
