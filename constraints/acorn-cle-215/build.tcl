# Bitstream and flash image for an Acorn CLE-215 with AMD's Vivado 2020.1 or newer:
#
#     cargo run --release -p incircle-hdl -- export --config full --top stream --width 128 -o device.v
#     vivado -mode batch -source constraints/acorn-cle-215/build.tcl -tclargs device.v build/acorn [PART]
#
# PART is xc7a200tfbg484-2, a CLE-215, unless another is given: xc7a200tfbg484-3 for a CLE-215+. A missed clock ends the
# script with an error and without a bitstream.

if {$argc < 2 || $argc > 3} {
    error "give the exported Verilog, a folder for the result, and the part if it is not a CLE-215"
}
set device [lindex $argv 0]
set out [lindex $argv 1]
set part [expr {$argc == 3 ? [lindex $argv 2] : "xc7a200tfbg484-2"}]
set here [file dirname [file normalize [info script]]]
if {![file readable $device]} {
    error "cannot read $device: export it first"
}
file mkdir $out

create_project -in_memory -part $part
set_property target_language Verilog [current_project]

# The bridge has four lanes of 5 GT/s, one stream of 128 bits at 125 MHz each way, and a window of registers.
create_ip -name xdma -vendor xilinx.com -library ip -module_name xdma_bridge -dir $out
set_property -dict [list \
    CONFIG.mode_selection Advanced \
    CONFIG.pl_link_cap_max_link_width X4 \
    CONFIG.pl_link_cap_max_link_speed 5.0_GT/s \
    CONFIG.axi_data_width 128_bit \
    CONFIG.axisten_freq 125 \
    CONFIG.xdma_axi_intf_mm AXI_Stream \
    CONFIG.xdma_rnum_chnl 1 \
    CONFIG.xdma_wnum_chnl 1 \
    CONFIG.axilite_master_en true \
    CONFIG.axilite_master_scale Kilobytes \
    CONFIG.axilite_master_size 4 \
    CONFIG.xdma_num_usr_irq 1 \
] [get_ips xdma_bridge]
generate_target all [get_ips xdma_bridge]
synth_ip [get_ips xdma_bridge]

read_verilog [list $device [file join $here top.v]]
read_xdc [file join $here early.xdc]
set_property PROCESSING_ORDER EARLY [get_files early.xdc]
read_xdc [file join $here pins.xdc]
read_xdc [file join $here crossings.xdc]
set_property PROCESSING_ORDER LATE [get_files crossings.xdc]

synth_design -top acorn_cle_215 -part $part
opt_design
place_design
phys_opt_design
route_design

report_timing_summary -file [file join $out timing.txt]
report_utilization -hierarchical -file [file join $out cells.txt]
report_cdc -details -file [file join $out crossings.txt]
set slack [get_property SLACK [get_timing_paths -max_paths 1]]
set hold [get_property SLACK [get_timing_paths -hold -max_paths 1]]
if {$slack < 0 || $hold < 0} {
    error "the clocks are missed by $slack ns (setup) or $hold ns (hold): $out/timing.txt says where"
}
write_bitstream -force [file join $out acorn-cle-215.bit]
write_cfgmem -force -format bin -interface spix4 -size 16 \
    -loadbit "up 0x0 [file join $out acorn-cle-215.bit]" -file [file join $out acorn-cle-215.bin]
puts "bitstream in $out, slack $slack ns"
