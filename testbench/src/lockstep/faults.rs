//! Faults that are put into the Verilog of a core, each behind a switch: one translated core has all of them.
//!
//! The build script replaces `sound` by `faults[place] ? broken : sound`, and gives the root module the port `faults`.
//! While no switch is on the core is sound. `Lockstep::faulty` turns switches on by name.

/// A fault: its name, and the expressions that it replaces.
pub struct Fault {
    /// Name of the fault, for `Lockstep::faulty`.
    pub name: &'static str,
    /// The expressions that the fault replaces.
    pub pieces: &'static [Piece],
}

/// One expression of the Verilog.
pub struct Piece {
    /// The text around the expression, with `@` in its place. The Verilog holds this text exactly once.
    pub around: &'static str,
    /// The expression as exported.
    pub sound: &'static str,
    /// The expression of the broken core.
    pub broken: &'static str,
}

const fn piece(around: &'static str, sound: &'static str, broken: &'static str) -> Piece {
    Piece { around, sound, broken }
}

/// All faults. The place of a fault in this list is its bit of the port `faults`.
pub const FAULTS: &[Fault] = &[
    // One comparison of the walk reversed, which decides which of two sides is lower.
    Fault {
        name: "comparison",
        pieces: &[piece(
            "leaves_by_side1 = @;",
            "edges[(64'h6)+:(1)] & (~edges[(64'h8)+:(1)])",
            "(~edges[(64'h6)+:(1)]) & (~edges[(64'h8)+:(1)])",
        )],
    },
    // One column of neighbours that is never written.
    Fault { name: "link", pieces: &[piece("links$2$write_enable = @;", "enables[(64'h3)+:(1)]", "1'b0")] },
    // One tie decided wrongly: the apex has no say.
    Fault {
        name: "tie",
        pieces: &[piece(
            "takes_tie = @;",
            "(order[(64'h1)+:(1)] & order[(64'h2)+:(1)]) | (order[(64'h6)+:(1)] & order[(64'h7)+:(1)])",
            "order[(64'h1)+:(1)] & order[(64'h2)+:(1)]",
        )],
    },
    // L1: a test ignores that another context holds the lock.
    Fault {
        name: "foreign_lock",
        pieces: &[
            piece("test_counts$d = @;", "tests & (~foreign)", "tests"),
            piece("test_is_refused$d = @;", "tests & foreign & (~holds_priority)", "1'b0"),
        ],
    },
    // L1: an attempt that aborts releases its locks while some of its visits are still in flight.
    Fault {
        name: "drain",
        pieces: &[piece("step[(64'h0)+:(1)] = @;", "ends_here", "ends_here | found[(64'hf)+:(1)]")],
    },
    // L1: a context does not rest after an abort.
    Fault { name: "rest", pieces: &[piece("is_rested = @;", "(~busy[index]) & rests_over", "~busy[index]")] },
    // L2: no context acquires the priority.
    Fault {
        name: "priority",
        pieces: &[piece("takes = @;", "outcome[(64'h8)+:(1)] & (~held$value[(64'h0)+:(1)])", "1'b0")],
    },
    // L2: all contexts count as those of one team, with one priority.
    Fault { name: "one_priority", pieces: &[piece("teams$write_data = @;", "planned[(64'h6)+:(5)]", "5'h0")] },
    // L3: the others do not yield to the context that holds the priority.
    Fault { name: "yield", pieces: &[piece("may_retry = @;", "~is_barred", "1'b1")] },
    // L4: locks are released when the ring is finished, before the star is written.
    Fault {
        name: "release",
        pieces: &[
            piece("locks$commit[(64'h0)+:(1)] = @;", "star$committed[(64'h0)+:(1)]", "commit[(64'h0)+:(1)]"),
            piece("job = @;", "star$committed[(64'h1)+:(56)]", "commit[(64'h1)+:(56)]"),
        ],
    },
    // L5: a locked root counts as in conflict with the point, without a second look.
    Fault {
        name: "root",
        pieces: &[
            piece("found[(64'h9)+:(1)] = @;", "root_is_held$q & is_in_conflict", "root_is_held$q"),
            piece(
                "found[(64'h12)+:(1)] = @;",
                "walk_is_torn$q | (walk_counts$q & (~is_corner)) | (root_is_held$q & is_in_conflict) | passes | asks_again",
                "walk_is_torn$q | (walk_counts$q & (~is_corner)) | root_is_held$q | passes | asks_again",
            ),
            piece(
                "found[(64'ha)+:(1)] = @;",
                "root_is_held$q & (~verdict[(64'h0)+:(1)]) & (~is_corner)",
                "1'b0",
            ),
            piece("found[(64'h11)+:(1)] = @;", "root_is_held$q & is_corner", "1'b0"),
        ],
    },
    // L6: a context opens a cavity while its own commit or release is due.
    Fault { name: "busy", pieces: &[piece("context_is_busy$d = @;", "is_busy", "1'b0")] },
    // L7: a walk ignores that a record is not written yet, or is being written.
    Fault { name: "watermark", pieces: &[piece("again1$d = @;", "is_torn | (~is_written)", "is_torn")] },
    Fault {
        name: "torn",
        pieces: &[piece(
            "is_torn = @;",
            "write[(64'h0)+:(1)] & (write[(64'h1)+:(15)] == issue$visit[(64'h28)+:(15)])",
            "1'b0",
        )],
    },
    // L8: all contexts work from the first triangle on.
    Fault { name: "first_round", pieces: &[piece("may_work = @;", "is_open", "seeded")] },
    // L8: all teams begin to work together, when the first of them is over its first round.
    Fault { name: "teams_together", pieces: &[piece("teams$asked = @;", "left$q[(64'h5)+:(5)]", "5'h0")] },
    // L9: a context takes its own locks for those of another one.
    Fault {
        name: "own_lock",
        pieces: &[piece(
            "foreign = @;",
            "met_clear3$q | (takes3$q & found_set$q & (~holder_is_own))",
            "met_clear3$q | (takes3$q & found_set$q)",
        )],
    },
    // L10: a walk goes on until a record holds the point.
    Fault {
        name: "walk_end",
        pieces: &[
            piece(
                "looks_again = @;",
                "walk_is_torn$q | (walk_counts$q & is_in_conflict & context_is_busy$q)",
                "walk_is_torn$q | (walk_counts$q & verdict[(64'h1)+:(1)] & (~is_corner) & context_is_busy$q)",
            ),
            piece(
                "found[(64'h7)+:(1)] = @;",
                "walk_counts$q & (~verdict[(64'h0)+:(1)]) & (~is_corner)",
                "walk_counts$q & (~verdict[(64'h1)+:(1)])",
            ),
            piece(
                "found[(64'h8)+:(1)] = @;",
                "walk_counts$q & is_in_conflict & (~context_is_busy$q)",
                "walk_counts$q & verdict[(64'h1)+:(1)] & (~is_corner) & (~context_is_busy$q)",
            ),
        ],
    },
    // L10: the edge across which a record was reached decides a tie.
    Fault {
        name: "tie_side",
        pieces: &[
            piece("faces_second = @;", "edges[(64'h1)+:(1)]", "is_second"),
            piece("faces_third = @;", "edges[(64'h2)+:(1)]", "is_third"),
        ],
    },
    // L11: the first walk of a context starts in the mesh of job 0.
    Fault { name: "any_mesh", pieces: &[piece("following[(64'hf)+:(15)] = @;", "wide_team << two", "15'h0")] },
    // The watchdog, and each place that hears of it except `CommandGate`. A core that
    // gets stuck over a lock has its first triangle already, so the gate holds nothing
    // back then; `tests/it/blocks/commands/command_gate.rs` tests the gate.
    Fault { name: "watchdog_is_silent", pieces: &[piece("is_stuck$d = @;", "1'b1", "1'b0")] },
    Fault {
        name: "command_port_ignores_stuck",
        pieces: &[piece("command_port$engine = @;", "engine$state", "engine$state & ~20'h8")],
    },
    Fault {
        name: "settle_ignores_stuck",
        pieces: &[piece("if (@) begin", "engine[(64'h2)+:(1)] | engine[(64'h3)+:(1)]", "engine[(64'h2)+:(1)]")],
    },
    Fault {
        name: "slot_ignores_stuck",
        pieces: &[piece(
            "has_room = @;",
            "(~engine[(64'h1)+:(1)]) & (~engine[(64'h3)+:(1)]) & (~is_full$q)",
            "(~engine[(64'h1)+:(1)]) & (~is_full$q)",
        )],
    },
    Fault {
        name: "answer_ignores_stuck",
        pieces: &[piece("answer_head$stuck = @;", "engine$state[(64'h3)+:(1)]", "1'b0")],
    },
    // Blocks that lack their reset.
    Fault { name: "command_port_without_reset", pieces: &[piece("command_port$reset = @;", "reset", "1'b0")] },
    Fault { name: "responder_without_reset", pieces: &[piece("responder$reset = @;", "reset", "1'b0")] },
    Fault { name: "engine_without_reset", pieces: &[piece("engine$reset = @;", "reset", "1'b0")] },
    Fault { name: "counters_without_reset", pieces: &[piece("counters$reset = @;", "reset", "1'b0")] },
    Fault { name: "latencies_without_reset", pieces: &[piece("latencies$reset = @;", "reset", "1'b0")] },
    Fault { name: "dispatcher_without_reset", pieces: &[piece("dispatcher$reset = @;", "reset", "1'b0")] },
    Fault { name: "watchdog_without_reset", pieces: &[piece("watchdog$reset = @;", "reset", "1'b0")] },
    Fault { name: "release_without_reset", pieces: &[piece("locks$reset = @;", "reset", "1'b0")] },
    Fault { name: "issue_without_reset", pieces: &[piece("issue$reset = @;", "reset", "1'b0")] },
];

/// Faults of the blocks that answer questions. The place of a fault in this list is its bit of the port `faults`.
pub const QUESTION_FAULTS: &[Fault] = &[
    Fault {
        name: "gate_passes_interpolate_on",
        pieces: &[piece(
            "begins = @;",
            "command$valid & standing[(64'h0)+:(1)] & (~is_active) & ((code == locate_code) | (code == interpolate_code) | (code == nearest_code) | (code == insert_code) | (code == delete_code) | (code == move_code))",
            "command$valid & standing[(64'h0)+:(1)] & (~is_active) & ((code == locate_code) | (code == nearest_code) | (code == insert_code) | (code == delete_code) | (code == move_code))",
        )],
    },
    Fault { name: "gate_passes_nearest_on", pieces: &[piece("nearest_code = @;", "32'ha", "32'h8")] },
    Fault {
        name: "answer_of_a_run_goes_first",
        pieces: &[piece("gives_run = @;", "run_response$valid & (~core_response$valid)", "run_response$valid")],
    },
    Fault { name: "missing_mesh_is_not_told", pieces: &[piece("if (@) begin", "~has_mesh", "1'b0")] },
    Fault { name: "all_items_for_one_context", pieces: &[piece("if (@) begin", "after_turn == contexts", "1'b1")] },
    Fault {
        name: "item_waits_at_an_end",
        pieces: &[piece(
            "meets_end = @;",
            "ends[(64'h0)+:(1)] & (ends[(64'h1)+:(5)] == dealt[(64'h1)+:(5)])",
            "1'b0",
        )],
    },
    Fault { name: "counts_are_not_cleared", pieces: &[piece("sweeps = @;", "~sweep$q[32'h5]", "1'b0")] },
    Fault { name: "walk_begins_at_record_0", pieces: &[piece("if (@) begin", "of_launch[32'h0]", "1'b0")] },
    Fault {
        name: "hint_follows_the_search",
        pieces: &[piece(
            "arrives = @;",
            "completion[(64'h0)+:(1)] & located & is_walk",
            "completion[(64'h0)+:(1)] & located & (is_walk | is_search)",
        )],
    },
    Fault {
        name: "search_ends_at_once",
        pieces: &[piece("passes_by = @;", "is_search & (~located)", "is_search")],
    },
    Fault { name: "side_1_decides_alone", pieces: &[piece("if (@) begin", "on_0 | on_1", "on_1")] },
    Fault {
        name: "weights_are_swapped",
        pieces: &[piece("low[(64'h20)+:(32)] = @;", "((e1) & 32'hffffffff)", "((e0) & 32'hffffffff)")],
    },
    Fault { name: "second_weight_is_lost", pieces: &[piece("if (@) begin", "beat == fourth", "1'b0")] },
    Fault { name: "parts_have_two_beats", pieces: &[piece("leaves = @;", "loads_part & ends_part", "loads_part & beat$q[0]")] },
    Fault {
        name: "run_ends_before_its_last_beat",
        pieces: &[piece(
            "is_over = @;",
            "(~head_is_due$q) & (~some_are_left$q) & (~valid$q)",
            "(~head_is_due$q) & (~some_are_left$q)",
        )],
    },
    // The search for the nearest vertex: the words of its runs, the nearest corner, the chains, the centre.
    Fault { name: "length_of_nearest_is_unknown", pieces: &[piece("if (@) begin", "is_short", "1'b0")] },
    Fault {
        name: "distance_is_not_compared",
        pieces: &[piece("compared$d[(64'h0)+:(1)] = @;", "distance_1 < distance_0", "1'b0")],
    },
    Fault {
        name: "slot_decides_a_tie",
        pieces: &[
            piece("(pairs[(64'h3)+:(1)] & (@))", "~rank[(64'h6)+:(1)]", "1'b0"),
            piece("(pairs[(64'h4)+:(1)] & (@))", "~rank[(64'h7)+:(1)]", "1'b0"),
            piece("(pairs[(64'h5)+:(1)] & (@))", "~rank[(64'h8)+:(1)]", "1'b0"),
        ],
    },
    Fault {
        name: "infinite_vertex_is_near",
        pieces: &[
            piece("infinite_0 = @;", "delay_infinite_0$flag_out", "1'b0"),
            piece("infinite_1 = @;", "delay_infinite_1$flag_out", "1'b0"),
            piece("infinite_2 = @;", "delay_infinite_2$flag_out", "1'b0"),
        ],
    },
    Fault {
        name: "chains_end_before_90_degrees",
        pieces: &[
            piece("next_is_past = (~nearest[(64'h4)+:(1)]) & (@)", "~nearest[(64'h2)+:(1)]", "1'b1"),
            piece("before_is_past = (~nearest[(64'h5)+:(1)]) & (@)", "~nearest[(64'h3)+:(1)]", "1'b1"),
        ],
    },
    Fault {
        name: "chains_go_on_behind_90_degrees",
        pieces: &[
            piece("ends_right = @ | looks_away", "next_is_past", "1'b0"),
            piece("ends_left = @ | (nearest", "before_is_past", "1'b0"),
        ],
    },
    Fault { name: "no_chain_to_the_right", pieces: &[piece("verdict[(64'h2)+:(1)] = @;", "~ends_right", "1'b0")] },
    Fault { name: "no_chain_to_the_left", pieces: &[piece("verdict[(64'h3)+:(1)] = @;", "~ends_left", "1'b0")] },
    Fault {
        name: "chains_pass_the_far_side",
        pieces: &[piece(
            "looks_away = @;",
            "(~nearest[(64'h4)+:(1)]) & (~nearest[(64'h5)+:(1)]) & next_is_left & before_is_right",
            "1'b0",
        )],
    },
    Fault {
        name: "chain_comes_back_across_the_hull",
        pieces: &[piece("comes_back_right = @;", "nearest[(64'h5)+:(1)] & next_is_left", "1'b0")],
    },
    Fault {
        name: "old_centre_counts",
        pieces: &[piece("counts = @;", "follows & (~(parity_entry[32'h0] ^ state[(64'h0)+:(1)]))", "follows")],
    },
    Fault {
        name: "nearer_vertex_is_passed",
        pieces: &[piece("is_nearer = @;", "nearest[(64'h0)+:(2)] == first_slot", "1'b0")],
    },
    Fault {
        name: "item_ends_with_its_first_chain",
        pieces: &[piece("(stays & (~goes_on) & (@));", "~other_goes", "1'b1")],
    },
];

/// Faults of the blocks that change a mesh that stands. The place of a fault in this list is its bit of the port
/// `faults`.
pub const CHANGE_FAULTS: &[Fault] = &[
    Fault { name: "high_vertex_is_not_refused", pieces: &[piece("high$d = @;", "vertex >= wide_capacity", "1'b0")] },
    Fault { name: "unknown_bits_are_trusted", pieces: &[piece("unknown$d = @;", "asked >= known$q", "1'b0")] },
    Fault {
        name: "vertex_in_use_is_not_refused",
        pieces: &[piece("is_refused = is_high | (@);", "item$is_used & (~is_unknown)", "1'b0")],
    },
    Fault {
        name: "duplicate_stays_in_use",
        pieces: &[piece(
            "unmarks = @;",
            "((events[(64'h1)+:(1)] & (~hole_runs)) | (events[(64'h27)+:(1)] & (~events[(64'h28)+:(1)]))) & (~is_move)",
            "1'b0",
        )],
    },
    Fault { name: "point_is_not_stored", pieces: &[piece("if (@) begin", "launch_stores$0", "1'b0")] },
    Fault {
        name: "ids_are_not_raised",
        pieces: &[piece("if (@) begin", "raises$0 & (raised$0 >= arrivals$q)", "1'b0")],
    },
    Fault { name: "contexts_take_points_after_a_change", pieces: &[piece("if (@) begin", "only_retries$0", "1'b0")] },
    Fault { name: "points_do_not_wait", pieces: &[piece("if (@) begin", "point_waits$0", "1'b0")] },
    Fault {
        name: "duplicates_of_runs_are_counted",
        pieces: &[piece("if (@) begin\n            events", "change_runs$0", "1'b0")],
    },
    // M11, in three parts: locks, parts and points.
    Fault {
        name: "run_ends_with_locks",
        pieces: &[piece("port$is_over = @;", "parts$is_over & (is_question | events[(64'h3f)+:(1)])", "parts$is_over")],
    },
    Fault {
        name: "insert_ends_with_points_at_work",
        pieces: &[piece(
            "is_pending = @;",
            "(~is_active) & (arrival[(64'h0)+:(1)] | late$holds | (~queues_rest))",
            "1'b0",
        )],
    },
    Fault {
        name: "number_of_the_item_handed_over_is_lost",
        pieces: &[piece("handed$write_enable = @;", "hands_over", "1'b0")],
    },
    Fault { name: "item_begins_beside_a_visit", pieces: &[piece("events[(64'h3e)+:(1)] = @ &", "(~may_ask)", "1'b1")] },
    Fault { name: "item_begins_beside_a_start", pieces: &[piece("& @ & (~fill_asks)", "(~wishes)", "1'b1")] },
    Fault { name: "item_begins_beside_a_test", pieces: &[piece("& @ & (~(late_waits", "(~fill_asks)", "1'b1")] },
    Fault {
        name: "item_begins_as_a_vertex_falls_out_of_use",
        pieces: &[piece("(~is_question) & @;", "(~changes$unmarks)", "1'b1")],
    },
    Fault {
        name: "vertex_goes_back_beside_a_late_point",
        pieces: &[piece("& @ & (~contexts", "(~(late_waits & moving[(64'h1)+:(1)]))", "1'b1")],
    },
    Fault {
        name: "vertex_of_a_late_item_is_not_marked",
        pieces: &[piece("marks_begun = @;", "begun$q & (~step$unmarks)", "1'b0")],
    },
    Fault { name: "hole_ends_beside_a_star", pieces: &[piece("| @ | commits", "may_settle", "1'b0")] },
    // M13.
    Fault {
        name: "item_begins_beside_a_solo_insertion",
        pieces: &[piece("& @;", "(~contexts[(64'h90)+:(1)]) & (~solo[(64'h0)+:(1)])", "1'b1")],
    },
    Fault {
        name: "root_is_no_hint",
        pieces: &[piece("arrives = @;", "step$arrives | (events[(64'h2)+:(1)] & changes$has_changed)", "step$arrives")],
    },
    Fault {
        name: "refusal_takes_no_place",
        pieces: &[piece(
            "parts$begins = @;",
            "(leaves_queues & port$is_active) | changes$is_noted",
            "leaves_queues & port$is_active",
        )],
    },
    Fault {
        name: "part_of_a_commit_goes_lost",
        pieces: &[piece("pops = @;", "done$valid & (~is_early)", "done$valid")],
    },
    // M2, M4, M5, M6, M8: the rules of deletions.
    Fault {
        name: "root_of_a_star_is_trusted",
        pieces: &[piece("\n        opens = @;", "kind$is_root & names_it", "kind$is_root")],
    },
    Fault {
        name: "foreign_locks_of_stars_are_ignored",
        pieces: &[
            piece("refused = @;", "is_live & is_foreign & (~is_awaited)", "1'b0"),
            piece("counts = @;", "is_live & (~is_foreign) & (~is_torn)", "is_live & (~is_awaited)"),
        ],
    },
    Fault {
        name: "nobody_waits_at_a_star",
        pieces: &[piece("again = @;", "is_live & (is_awaited | is_torn)", "1'b0")],
    },
    Fault {
        name: "locks_of_a_star_are_released_too_soon",
        pieces: &[piece(
            "erased[(64'h0)+:(1)] = @;",
            "valid$q[32'h5] & job5$q[(64'h1a)+:(1)]",
            "valid$q[32'h0] & job0$q[(64'h1a)+:(1)]",
        )],
    },
    Fault {
        name: "free_records_lead_nowhere",
        pieces: &[
            piece("record$n0 = @;", "apex_id", "record$id"),
            piece("record$n1 = @;", "apex_id", "record$id"),
            piece("record$n2 = @;", "apex_id", "record$id"),
        ],
    },
    Fault {
        name: "chain_meets_an_old_head",
        pieces: &[piece("has_new_head = @;", "goes & (is_early_right != entry[32'h5])", "1'b0")],
    },
    Fault {
        name: "star_is_over_too_soon",
        pieces: &[piece("after[(64'h4a)+:(1)] = @;", "outstanding == two", "1'b1")],
    },
    Fault { name: "chains_do_not_meet", pieces: &[piece("step$meets = @;", "store$meets", "1'b0")] },
    Fault { name: "apex_is_not_replaced", pieces: &[piece("(@ | (~best_is_left))", "verdict[(64'h0)+:(1)]", "1'b0")] },
    Fault {
        name: "flat_holes_are_filled",
        pieces: &[piece("restarts = @;", "hole[(64'h31)+:(1)] & has_left", "1'b0")],
    },
    Fault { name: "side_of_a_hole_is_not_mended", pieces: &[piece("third = @;", "side$write", "110'b0")] },
    Fault { name: "kept_ids_are_forgotten", pieces: &[piece("has_ids = @;", "pair$q[32'h1e]", "1'b0")] },
    Fault {
        name: "ids_of_a_deletion_go_lost",
        pieces: &[piece("if (@ & (~moving[(64'h0)+:(1)])) begin", "kept[(64'h0)+:(1)]", "1'b0")],
    },
    Fault { name: "ids_of_a_duplicate_go_lost", pieces: &[piece("if (@ & has_own) begin", "ends_in_vain", "1'b0")] },
    Fault {
        name: "duplicate_has_no_ids",
        pieces: &[piece("check$unmarked_owns = @;", "events[(64'h5e)+:(1)]", "1'b0")],
    },
    Fault {
        name: "ids_of_a_ring_are_those_of_the_next_item",
        pieces: &[piece("handed$write_enable = @;", "commit[(64'h0)+:(1)]", "1'b1")],
    },
    Fault { name: "free_records_are_read_out", pieces: &[piece("lives = comes & @ &", "(~is_free)", "1'b1")] },
    // M12, M14: the rules of moves.
    Fault { name: "edges_are_not_looked_at", pieces: &[piece("stays = @;", "(~turns_left) | conflict", "1'b1")] },
    Fault { name: "records_outside_are_not_looked_at", pieces: &[piece("keeps = @;", "~conflict", "1'b1")] },
    Fault {
        name: "last_edge_is_not_looked_at",
        pieces: &[piece("keeps = @;\n        end\n        root_left", "stays", "1'b1")],
    },
    Fault {
        name: "vertices_of_the_hull_move_in_place",
        pieces: &[piece("(keeps_all & (@))", "~held[(64'h2a)+:(1)]", "1'b1")],
    },
    Fault { name: "chains_carry_one_vertex", pieces: &[piece("carried0$d = @;", "right$read_data", "left$read_data")] },
    Fault {
        name: "stars_are_judged_by_the_old_place",
        pieces: &[piece("is_moved1$d = @;", "(~out0$q) & (visit[(64'h6)+:(1)] | is_last_edge)", "1'b0")],
    },
    Fault { name: "own_place_is_another_one", pieces: &[piece("is_kept = moves & (@ |", "stays", "1'b0")] },
    Fault {
        name: "torn_points_count",
        pieces: &[piece("torn2$d = @ |", "(written1$q[(64'h0)+:(1)] & is_written)", "1'b0")],
    },
    Fault { name: "fetch_beside_a_write_counts", pieces: &[piece("| @;\n        torn3$d", "meets_write1$q", "1'b0")] },
    Fault { name: "point_of_a_move_is_not_written", pieces: &[piece("if (@) begin", "late$0$writes", "1'b0")] },
    Fault {
        name: "vertex_is_read_before_its_late_point",
        pieces: &[piece("fetches$0 = pipeline$fetches$0 | @ |", "late$0$waits", "1'b0")],
    },
    Fault {
        name: "commit_writes_beside_a_hole",
        pieces: &[piece("commits$holds$0 = @;", "holes$0$writes_next", "1'b0")],
    },
    Fault {
        name: "last_edge_is_asked_for_beside_a_launch",
        pieces: &[piece("kind$may_ask | @;", "step$may_close", "1'b0")],
    },
    Fault {
        name: "vertex_that_has_moved_is_missing",
        pieces: &[piece("remarks = is_refused | @ |", "is_moved", "1'b0")],
    },
    Fault { name: "test_pushes_beside_a_visit", pieces: &[piece("pushes = asks & @ &", "(~asks_or_may)", "1'b1")] },
];
