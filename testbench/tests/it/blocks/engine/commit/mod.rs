//! Tests of the blocks in `hdl/src/engine/commit`.

#[expect(clippy::module_inception, reason = "the room carries the name of its main block")]
mod commit;
mod fresh_ids;
mod inner_list;
mod job_queue;
mod release;
mod ring_reader;
mod star_id;
