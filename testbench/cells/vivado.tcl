# Runs a build script for Vivado without Vivado. Stand-ins for its commands print their names and do nothing. So a
# script fails if it calls an unknown command, passes on an unset variable or leaves a bracket open. Yosys runs this
# file, because it has a Tcl of its own.
#
# The environment names the SCRIPT, its ARGUMENTS (a list), the SLACK that timing reports, and the CONSTRAINTS (a list
# of files that are read as scripts, too).
foreach command {
    create_clock create_ip create_project current_design current_project generate_target get_cells get_clocks get_files get_ips get_pins
    get_ports get_timing_paths opt_design phys_opt_design place_design read_verilog read_xdc report_cdc report_timing_summary
    report_utilization reset_property route_design set_max_delay set_property synth_design synth_ip write_bitstream write_cfgmem
} {
    proc $command args "puts \"stand-in: $command\"; return $command"
}
proc get_property args { return $::env(SLACK) }

foreach file $env(CONSTRAINTS) {
    source $file
}
set argv $env(ARGUMENTS)
set argc [llength $argv]
source $env(SCRIPT)
