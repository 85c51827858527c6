# The two clocks are asynchronous. A signal that crosses goes into the first cell of a synchroniser (ASYNC_REG), and
# must arrive within one period of the bus clock, so that the bits of a Gray pointer stay within one step of each other.
# Nothing else crosses: protocol/STREAM.md lists the crossings, and constraints/crossings checks the list. Every path
# between the clocks that does not end in such a cell stays under the constraints of its clocks.
set_max_delay -datapath_only 8.000 -from [get_clocks -of_objects [get_pins clocks/CLKOUT0]] \
    -to [get_cells -hierarchical -filter {ASYNC_REG == TRUE}]
set_max_delay -datapath_only 8.000 -from [get_clocks -of_objects [get_pins bridge/axi_aclk]] \
    -to [get_cells -hierarchical -filter {ASYNC_REG == TRUE}]
