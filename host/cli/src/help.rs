//! The ends of the help texts: examples to copy.
//!
//! The short help of a command ends in one example, the long help in several.

/// End of `incircle -h`.
pub const ALL: &str = "\
Exit codes: 0 ok, 1 verification failed, 2 usage, 3 bad input, 4 device not found or no permission,
5 link error, 6 device error or timeout, 7 capacity, 130 interrupted.

Example:
  incircle triangulate points.csv -o mesh.obj";

/// End of `incircle --help`.
pub const ALL_LONG: &str = "\
Exit codes:
  0    ok
  1    verification failed
  2    usage: the arguments are wrong
  3    bad input: a file cannot be read or written, or its content is wrong
  4    device not found, or no permission to use it
  5    link error
  6    device error or timeout
  7    capacity: too many points, or the memory of a device is full
  130  interrupted

Examples:
  incircle generate uniform -n 1000 -o points.csv        make a set of points
  incircle triangulate points.csv -o mesh.obj            triangulate it
  incircle triangulate points.csv -o picture.svg         look at it
  incircle verify points.csv mesh.obj                    prove that the mesh is right
  incircle bench --backend clock                         count the cycles of the core";

/// End of `incircle triangulate -h`.
pub const TRIANGULATE: &str = "\
Example:
  incircle triangulate points.csv -o mesh.obj";

/// End of `incircle triangulate --help`.
pub const TRIANGULATE_LONG: &str = "\
Examples:
  incircle triangulate points.csv -o mesh.obj
  incircle triangulate cities.geojson -o picture.svg
  incircle triangulate - -o - --format csv < points.csv
  incircle triangulate survey.laz -o ground.ply --class 2
  incircle triangulate arrays.npz --array xy -o triangles.npy
  incircle triangulate points.csv -o mesh.ply --backend clock --config full --json
  incircle triangulate points.csv -o mesh.ply --backend serial:/dev/ttyUSB0";

/// End of `incircle verify -h`.
pub const VERIFY: &str = "\
Example:
  incircle verify points.csv mesh.obj";

/// End of `incircle verify --help`.
pub const VERIFY_LONG: &str = "\
Examples:
  incircle verify points.csv mesh.obj
  incircle verify points.csv mesh.ele --json
  incircle verify big.npy mesh.npy --memory 1G
  incircle verify tracks.txt mesh.obj --script";

/// End of `incircle generate -h`.
pub const GENERATE: &str = "\
Example:
  incircle generate kuzmin -n 1000 -o points.csv";

/// End of `incircle generate --help`.
pub const GENERATE_LONG: &str = "\
Examples:
  incircle generate kuzmin -n 1000 -o points.csv
  incircle generate uniform -n 1000000 --bits 20 --seed 7 -o points.node
  incircle generate clusters -n 1000 --numbers decimal -o points.csv
  incircle generate uniform -n 1000000 --numbers double -o points.npy
  incircle generate lattice -n 256 --order hilbert -o order.svg
  incircle generate tracks -n 400 --frames 60 -o tracks.txt";

/// End of `incircle replay -h`.
pub const REPLAY: &str = "\
Example:
  incircle replay tracks.txt -o mesh.obj --answers answers.txt";

/// End of `incircle replay --help`.
pub const REPLAY_LONG: &str = "\
Examples:
  incircle generate tracks -n 400 --frames 60 -o tracks.txt
  incircle replay tracks.txt -o mesh.obj --answers answers.txt
  incircle verify tracks.txt mesh.obj --script
  incircle replay tracks.txt --film film.svg
  incircle replay - -o mesh.json --backend model --json < tracks.txt";

/// End of `incircle bench -h`.
pub const BENCH: &str = "\
Example:
  incircle bench uniform lattice -n 1000 --backend clock";

/// End of `incircle bench --help`.
pub const BENCH_LONG: &str = "\
Examples:
  incircle bench uniform lattice -n 1000 --backend clock
  incircle bench --backend cpu --threads 1 -n 1000000 --coord-bits 20
  incircle bench uniform --batch 1000 -n 200 --backend clock --json";

/// End of `incircle tile -h`.
pub const TILE: &str = "\
Example:
  incircle tile split points.npy --points 1000000 -o tiles";

/// End of `incircle tile --help`.
pub const TILE_LONG: &str = "\
Examples:
  incircle tile split points.npy --points 1000000 -o tiles
  incircle tile local tiles/0                            for each tile, here or elsewhere
  incircle tile join tiles -o mesh.npy";

/// End of `incircle tile split -h`.
pub const SPLIT: &str = "\
Example:
  incircle tile split points.npy --points 1000000 -o tiles";

/// End of `incircle tile split --help`.
pub const SPLIT_LONG: &str = "\
Examples:
  incircle tile split points.npy --points 1000000 -o tiles
  incircle tile split west.laz east.laz --points 2000000 -o tiles --class 2 --json";

/// End of `incircle tile local -h`.
pub const LOCAL: &str = "\
Example:
  incircle tile local tiles/0";

/// End of `incircle tile local --help`.
pub const LOCAL_LONG: &str = "\
Examples:
  incircle tile local tiles/0
  incircle tile local tiles/$SLURM_ARRAY_TASK_ID --threads 1
  incircle tile local tiles/7 --backend clock?config=full";

/// End of `incircle tile join -h`.
pub const JOIN: &str = "\
Example:
  incircle tile join tiles -o mesh.npy";

/// End of `incircle tile join --help`.
pub const JOIN_LONG: &str = "\
Examples:
  incircle tile join tiles -o mesh.npy
  incircle tile join tiles -o mesh.npy --memory 1G
  incircle tile join tiles -o mesh.csv.zst --unordered";

/// End of `incircle voronoi -h`.
pub const VORONOI: &str = "\
Example:
  incircle voronoi points.csv -o cells.geojson";

/// End of `incircle voronoi --help`.
pub const VORONOI_LONG: &str = "\
Examples:
  incircle voronoi points.csv -o cells.geojson
  incircle voronoi cities.geojson -o cells.svg --clip-to country.geojson
  incircle voronoi points.csv -o cells.json --clip 0,0,1000,1000
  incircle voronoi points.npy -o cells.geojson.gz --quantize fit";

/// End of `incircle interpolate -h`.
pub const INTERPOLATE: &str = "\
Example:
  incircle interpolate survey.csv --grid 0.5 -o heights.npy";

/// End of `incircle interpolate --help`.
pub const INTERPOLATE_LONG: &str = "\
Examples:
  incircle interpolate survey.csv --grid 0.5 -o heights.npy
  incircle interpolate survey.laz --class 2 --grid 1 -o ground.asc
  incircle interpolate wells.csv --value depth --at places.csv -o depths.csv --method sibson";

/// End of `incircle lloyd -h`.
pub const LLOYD: &str = "\
Example:
  incircle lloyd points.csv -o even.csv --iterations 20";

/// End of `incircle lloyd --help`.
pub const LLOYD_LONG: &str = "\
Examples:
  incircle lloyd points.csv -o even.csv --iterations 20
  incircle lloyd points.csv -o even.npy --until-still --clip 0,0,1000,1000
  incircle lloyd survey.csv -o even.csv --iterations 5 --quantize fit";

/// End of `incircle info -h`.
pub const INFO: &str = "\
Example:
  incircle info --port /dev/ttyUSB0";

/// End of `incircle info --help`.
pub const INFO_LONG: &str = "\
Examples:
  incircle info --port /dev/ttyUSB0
  incircle info --backend clock --config large
  incircle info --backend pcie:0";

/// End of both help texts of `incircle devices`.
pub const DEVICES: &str = "\
Example:
  incircle devices --greet";

/// End of `incircle completions -h`.
pub const COMPLETIONS: &str = "\
Example:
  incircle completions bash > incircle.bash";

/// End of `incircle completions --help`.
pub const COMPLETIONS_LONG: &str = "\
Examples:
  incircle completions bash > incircle.bash
  incircle completions zsh > _incircle";

/// End of `incircle man -h`.
pub const MAN: &str = "\
Example:
  incircle man triangulate | man -l -";

/// End of `incircle man --help`.
pub const MAN_LONG: &str = "\
Examples:
  incircle man triangulate | man -l -
  incircle man tile split > incircle-tile-split.1";
