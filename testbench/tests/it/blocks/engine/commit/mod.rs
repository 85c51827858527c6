//! The blocks of `hdl/src/engine/commit`.

mod commit;
mod fresh_ids;
mod inner_list;
mod job_queue;
mod release;
mod ring_reader;
mod star_id;
