"""The core behind its stream link as a module of LiteX.

docs/core-in-your-design.md says how to use the module. Tested with litex 2024.12 and migen 0.10.0.
SPDX-License-Identifier: MIT OR Apache-2.0
"""

from pathlib import Path
from typing import Any

from litex.gen import LiteXModule
from litex.soc.integration.soc import SoCRegion
from litex.soc.interconnect import stream
from litex.soc.interconnect.axi import AXILiteInterface
from migen import ClockSignal, Instance, ResetSignal

VERILOG = Path(__file__).resolve().parent.parent / "verilog"
BEAT_BITS = 64
ADDRESS_BITS = 12


class Incircle(LiteXModule):
    """A core with one stream of commands, one of answers, and registers.

    `sink` takes beats of two words of commands, and `source` gives beats of answers, the last of each with `last`. Both
    work in the clock of the system. `bus` holds the registers. A DMA engine can be connected to `sink` and `source`:
    both are endpoints with a payload `data` of 64 bits.
    """

    def __init__(self, platform: Any, configuration: str = "small", core_clock_domain: str = "sys") -> None:
        """Makes a core and adds its Verilog to the platform.

        `configuration` is small, full, dual or quad. The clock of `core_clock_domain` may have 1/4 to 4 times the rate
        of the system's. A name without a file in hdl/verilog is a ValueError.
        """
        file = VERILOG / f"incircle_{configuration}_stream.v"
        if not file.is_file():
            raise ValueError(f"{file} is missing: choose small, full, dual or quad, and keep this file in its checkout")
        platform.add_source(str(file))

        self.sink = stream.Endpoint([("data", BEAT_BITS)])
        self.source = stream.Endpoint([("data", BEAT_BITS)])
        self.bus = AXILiteInterface(data_width=32, address_width=32)
        self.specials += Instance(
            "incircle_stream_top",
            i_bus_clock=ClockSignal("sys"),
            i_bus_reset_n=~ResetSignal("sys"),
            i_core_clock=ClockSignal(core_clock_domain),
            i_s_axis_tdata=self.sink.data,
            # The link drops beats with holes, and LiteX's endpoints have none.
            i_s_axis_tkeep=2 ** (BEAT_BITS // 8) - 1,
            i_s_axis_tvalid=self.sink.valid,
            o_s_axis_tready=self.sink.ready,
            i_s_axis_tlast=self.sink.last,
            o_m_axis_tdata=self.source.data,
            o_m_axis_tvalid=self.source.valid,
            i_m_axis_tready=self.source.ready,
            o_m_axis_tlast=self.source.last,
            **self._registers(),
        )

    def _registers(self) -> dict[str, Any]:
        """Returns the connections of the registers to `bus`."""
        ports: dict[str, Any] = {}
        for name in ("aw", "w", "ar"):
            channel = getattr(self.bus, name)
            ports |= {f"i_s_axi_{name}valid": channel.valid, f"o_s_axi_{name}ready": channel.ready}
        for name in ("b", "r"):
            channel = getattr(self.bus, name)
            ports |= {f"o_s_axi_{name}valid": channel.valid, f"i_s_axi_{name}ready": channel.ready}
            ports[f"o_s_axi_{name}resp"] = channel.resp
        for name in ("aw", "ar"):
            channel = getattr(self.bus, name)
            ports |= {f"i_s_axi_{name}addr": channel.addr[:ADDRESS_BITS], f"i_s_axi_{name}prot": channel.prot}
        ports |= {"i_s_axi_wdata": self.bus.w.data, "i_s_axi_wstrb": self.bus.w.strb}
        return ports | {"o_s_axi_rdata": self.bus.r.data}


def add_incircle(soc: Any, origin: int, **options: Any) -> Incircle:
    """Adds a core to a system on chip, with its registers at `origin` in 4096 bytes, and returns the core."""
    core = Incircle(soc.platform, **options)
    soc.add_module(name="incircle", module=core)
    soc.bus.add_slave("incircle", core.bus, SoCRegion(origin=origin, size=2**ADDRESS_BITS, cached=False))
    return core
