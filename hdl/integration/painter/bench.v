// Simulates the painter, reads the bits on the lanes of its video output as a screen does, and writes each picture to a
// file: picture_0.ppm has value 0 everywhere, picture_1.ppm is the first mesh. docs/core-in-your-design.md has the
// command.
// `+pictures=N` writes pictures 0 to N, 1 if it is left out. `$stop` ends the program with an error if a picture is not
// whole, if the core refuses a command, or if no screen comes.
// SPDX-License-Identifier: MIT OR Apache-2.0
`timescale 1ns / 1ps
`default_nettype none
module painter_bench;
    reg clock = 0, video_clock = 0, reset = 1;
    always #10 clock = !clock;
    always #4 video_clock = !video_clock;
    wire [7:0] lanes;
    wire is_painting, has_failed;
    painter painter (
        .clock(clock), .reset(reset), .video_clock(video_clock),
        .lanes(lanes), .is_painting(is_painting), .has_failed(has_failed)
    );

    // Collects ten bits of each lane. A symbol begins where the clock of the pixels rises.
    reg [9:0] blue, green, red, pixel_clock;
    reg [31:0] file, last, picture, pixels, lines;
    reg [8 * 32 - 1:0] name;
    reg is_sync, is_blank, was_in_sync;
    initial begin
        if (!$value$plusargs("pictures=%d", last)) last = 1;
        {picture, pixels, file, was_in_sync} = 0;
        {blue, green, red, pixel_clock} = 0;
        repeat (8) @(negedge clock);
        reset = 0;
    end

    // A screen takes 16.8 ms. A bench that counts no new one for 100 ms would wait for ever.
    reg [31:0] screens, screens_before;
    initial begin
        {screens, screens_before} = 0;
        forever begin
            repeat (100) #1000000;
            if (screens == screens_before) stops;
            screens_before = screens;
        end
    end
    task stops; begin
        $display("no screen has come for 100 ms of simulated time");
        $stop;
    end endtask

    // The byte of a symbol: the encoder's steps, backwards.
    function [7:0] decoded(input [9:0] symbol);
        reg [7:0] word;
        begin
            word = symbol[7:0] ^ {8{symbol[9]}};
            decoded = word ^ {word[6:0], 1'b0} ^ (symbol[8] ? 8'h00 : 8'hfe);
        end
    endfunction

    always @(negedge video_clock) begin
        // The bench works at falling edges, where all signals are at rest.
        blue = {lanes[1:0], blue[9:2]};
        green = {lanes[3:2], green[9:2]};
        red = {lanes[5:4], red[9:2]};
        pixel_clock = {lanes[7:6], pixel_clock[9:2]};
        if (pixel_clock == 10'b0000011111) begin
            // Four symbols have no colour. The two with a low bit of vertical synchronisation end a screen.
            is_sync = blue == 10'b1101010100 || blue == 10'b0010101011;
            is_blank = is_sync || blue == 10'b0101010100 || blue == 10'b1010101011;
            if (is_sync && !was_in_sync) ends_screen;
            was_in_sync = is_sync;
            if (!is_blank && file != 0) begin
                $fwrite(file, "%0d %0d %0d\n", decoded(red), decoded(green), decoded(blue));
                pixels = pixels + 1;
            end
        end
    end

    // The first screen may have begun before the bench, so the first file begins with the second one.
    task ends_screen; begin
        if (file != 0) begin
            $fclose(file);
            $display("%0s has %0d pixels", name, pixels);
            if (pixels != 640 * 480) begin
                $display("the screen should have %0d pixels", 640 * 480);
                $stop;
            end
            picture = picture + 1;
        end
        if (has_failed) begin
            $display("the core has refused a command");
            $stop;
        end
        screens = screens + 1;
        if (picture > last) $finish;
        else begin
            $sformat(name, "picture_%0d.ppm", picture);
            file = $fopen(name, "w");
            $fwrite(file, "P3\n640 480\n255\n");
            pixels = 0;
        end
    end endtask
endmodule
`default_nettype wire
