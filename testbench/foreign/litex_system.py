"""Makes a system of LiteX around the core and writes its Verilog, which the caller lets Icarus elaborate."""

import sys
from pathlib import Path

from litex.build.generic_platform import GenericPlatform, Pins
from litex.gen import LiteXModule
from litex.soc.integration.soc_core import SoCMini
from litex.soc.interconnect.wishbone import Interface
from migen import ClockDomain

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "hdl" / "integration"))
from incircle_litex import add_incircle

PINS = [
    ("clk", 0, Pins(1)),
    ("core_clk", 0, Pins(1)),
    ("rst", 0, Pins(1)),
]


class Clocks(LiteXModule):
    """Two clocks and a reset from pins."""

    def __init__(self, platform: GenericPlatform) -> None:
        self.cd_sys = ClockDomain()
        self.cd_core = ClockDomain(reset_less=True)
        self.comb += self.cd_sys.clk.eq(platform.request("clk"))
        self.comb += self.cd_sys.rst.eq(platform.request("rst"))
        self.comb += self.cd_core.clk.eq(platform.request("core_clk"))


class System(SoCMini):
    """A bus with a core, whose answers come back to it as commands: enough to connect every port."""

    def __init__(self, platform: GenericPlatform) -> None:
        super().__init__(platform, clk_freq=100_000_000, ident="", ident_version=False)
        self.crg = Clocks(platform)
        core = add_incircle(self, origin=0x3000_0000, configuration="small", core_clock_domain="core")
        self.comb += core.source.connect(core.sink)
        self.bus.add_master("outside", Interface(data_width=32, address_width=32, addressing="word"))


def main(out: Path) -> None:
    """Writes `system.v` into the folder, and `files.txt` with the paths of all Verilog files."""
    platform = GenericPlatform("none", PINS)
    system = System(platform)
    system.finalize()
    verilog = platform.get_verilog(system, name="system")
    out.mkdir(parents=True, exist_ok=True)
    verilog.write(str(out / "system.v"))
    files = [out / "system.v", *(Path(source[0]) for source in platform.sources)]
    (out / "files.txt").write_text("".join(f"{file}\n" for file in files))


if __name__ == "__main__":
    main(Path(sys.argv[1]))
