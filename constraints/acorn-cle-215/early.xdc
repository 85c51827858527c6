# Read before the constraints of the bridge, which give its lanes the sites of a reference board. This board has its
# lanes in another order. Without those sites the lanes follow the pins in pins.xdc.
reset_property LOC [get_cells -hierarchical -filter {NAME =~ *gtp_channel.gtpe2_channel_i}]
