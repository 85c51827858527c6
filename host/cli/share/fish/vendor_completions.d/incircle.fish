# Print an optspec for argparse to handle cmd's options that are independent of any subcommand.
function __fish_incircle_global_optspecs
    string join \n h/help V/version
end

function __fish_incircle_needs_command
    # Figure out if the current invocation already has a command.
    set -l cmd (commandline -opc)
    set -e cmd[1]
    argparse -s (__fish_incircle_global_optspecs) -- $cmd 2>/dev/null
    or return
    if set -q argv[1]
        # Also print the command, so this can be used to figure out what it is.
        echo $argv[1]
        return 1
    end
    return 0
end

function __fish_incircle_using_subcommand
    set -l cmd (__fish_incircle_needs_command)
    test -z "$cmd"
    and return 1
    contains -- $cmd[1] $argv
end

complete -c incircle -n "__fish_incircle_needs_command" -s h -l help -d 'Print help (see more with \'--help\')'
complete -c incircle -n "__fish_incircle_needs_command" -s V -l version -d 'Print version'
complete -c incircle -n "__fish_incircle_needs_command" -f -a "triangulate" -d 'Triangulate a file of points'
complete -c incircle -n "__fish_incircle_needs_command" -f -a "verify" -d 'Check that a mesh is the canonical Delaunay triangulation of its points'
complete -c incircle -n "__fish_incircle_needs_command" -f -a "generate" -d 'Make a set of points, or a script for \'replay\''
complete -c incircle -n "__fish_incircle_needs_command" -f -a "bench" -d 'Measure a back end on generated sets, with a row of a table for each set'
complete -c incircle -n "__fish_incircle_needs_command" -f -a "tile" -d 'Triangulate a set in tiles over files: larger than the memory, or on many machines'
complete -c incircle -n "__fish_incircle_needs_command" -f -a "replay" -d 'Carry out a script of changes and questions on a mesh that lives'
complete -c incircle -n "__fish_incircle_needs_command" -f -a "voronoi" -d 'Compute the Voronoi cells of a file of points, exactly'
complete -c incircle -n "__fish_incircle_needs_command" -f -a "interpolate" -d 'Work out values between points, such as heights: at places of a file, or on a grid'
complete -c incircle -n "__fish_incircle_needs_command" -f -a "lloyd" -d 'Spread points evenly: move each to the centroid of its Voronoi cell, again and again'
complete -c incircle -n "__fish_incircle_needs_command" -f -a "info" -d 'Describe a back end: version, coordinates, capacity, contexts'
complete -c incircle -n "__fish_incircle_needs_command" -f -a "devices" -d 'List the serial ports and the PCIe cards of this machine, or the devices on the network'
complete -c incircle -n "__fish_incircle_needs_command" -f -a "completions" -d 'Print a completion script for a shell'
complete -c incircle -n "__fish_incircle_needs_command" -f -a "man" -d 'Print a page for \'man\', of the command or of a subcommand'
complete -c incircle -n "__fish_incircle_needs_command" -f -a "help" -d 'Print this message or the help of the given subcommand(s)'
complete -c incircle -n "__fish_incircle_using_subcommand triangulate" -s o -l output -d 'File for the mesh, in the format of its extension' -r -F
complete -c incircle -n "__fish_incircle_using_subcommand triangulate" -l format -d 'Mesh format' -r -f -a "ele\t'Shewchuk\'s Triangle, .ele: `N 3 0`, then `id a b c`, counted from 0'
obj\t'Wavefront OBJ'
ply\t'PLY, ascii'
ply-binary\t'PLY, binary: doubles, little endian'
vtk\t'Legacy VTK, ascii'
geojson\t'GeoJSON with a polygon for each triangle'
json\t'Points, triangles, hull and duplicates'
csv\t'Rows `a,b,c`'
npy\t'An array of NumPy, of shape (m, 3) and type u4'
svg\t'A picture'"
complete -c incircle -n "__fish_incircle_using_subcommand triangulate" -l from -d 'Point format' -r -f -a "csv\t'Rows `x,y`, header optional'
xyz\t'Rows `x y [z]`'
node\t'Shewchuk\'s Triangle, .node'
poly\t'Shewchuk\'s Triangle, .poly: points and constraints'
obj\t'Vertices of a Wavefront OBJ'
ply\t'Vertices of a PLY, ascii or binary'
geojson\t'Points of GeoJSON'
json\t'The list `points` of a JSON mesh, or GeoJSON'
las\t'LAS, LAZ or COPC, from laser scanners'
npy\t'An array of NumPy, of shape (n, 2) or (n, 3)'
npz\t'An archive of arrays of NumPy; see --array'
wkt\t'Points of WKT (well-known text)'"
complete -c incircle -n "__fish_incircle_using_subcommand triangulate" -l class -d 'Take only LiDAR points of these classes, such as 2,9: whole numbers from 0 to 255' -r
complete -c incircle -n "__fish_incircle_using_subcommand triangulate" -l bounds -d 'Take only LiDAR points in this rectangle, edges included: \'X0,Y0,X1,Y1\'' -r
complete -c incircle -n "__fish_incircle_using_subcommand triangulate" -l array -d 'Array of points in an .npz archive (default: the only array)' -r
complete -c incircle -n "__fish_incircle_using_subcommand triangulate" -l coord-bits -d 'Bits of a coordinate of the grid of --quantize, 8 to 31 (default: 31, or 16 for a core)' -r
complete -c incircle -n "__fish_incircle_using_subcommand triangulate" -l quantize -d 'Round the points onto a grid: \'fit\', \'SCALE\' or \'SCALE,X0,Y0\'' -r
complete -c incircle -n "__fish_incircle_using_subcommand triangulate" -l backend -d 'Back end' -r -f -a "cpu\t''
model\t''
clock\t''
sim\t''
serial:PORT\t''
udp:HOST\t''
pcie:N\t''"
complete -c incircle -n "__fish_incircle_using_subcommand triangulate" -l threads -d 'Threads of the back end \'cpu\' (default: one per processor)' -r
complete -c incircle -n "__fish_incircle_using_subcommand triangulate" -l config -d 'Core of \'clock\' and \'sim\'' -r -f -a "tiny\t'8 points, 2 contexts'
small\t'1024 points, 16 contexts'
full\t'8192 points, 16 contexts'
large\t'16384 points, 24 contexts'
dual\t'2 engines, each with 4096 points, 16 contexts'
quad\t'4 engines, each with 2048 points, 16 contexts'"
complete -c incircle -n "__fish_incircle_using_subcommand triangulate" -l contexts -d 'Insertions in flight at once (default: all contexts of the back end)' -r
complete -c incircle -n "__fish_incircle_using_subcommand triangulate" -l order -d 'Insertion order' -r -f -a "brio-hilbert\t''
hilbert\t''
input\t''
random\t''"
complete -c incircle -n "__fish_incircle_using_subcommand triangulate" -l timeout -d 'Seconds that a job may take (default: 60, and 0.002 for each point)' -r
complete -c incircle -n "__fish_incircle_using_subcommand triangulate" -l constraints -d 'Edges that must be in the mesh: a CSV file of pairs of point indices, counted from 0' -r -F
complete -c incircle -n "__fish_incircle_using_subcommand triangulate" -l domain -d 'Triangles that are wanted' -r -f -a "all\t'All triangles of the hull'
holes\t'Triangles that constraints separate from the outside and from all holes'
even-odd\t'Triangles that an odd number of rings surround'
non-zero\t'Triangles that rings run around more often in one direction than in the other'"
complete -c incircle -n "__fish_incircle_using_subcommand triangulate" -l crossings -d 'Treatment of constraints that cross' -r -f -a "reject\t'Crossings are an error, whose message has the place'
snap\t'Crossings become points, rounded to a grid 256 times finer'"
complete -c incircle -n "__fish_incircle_using_subcommand triangulate" -l edges -d 'Write the edges of the mesh into this file as well, in the format .edge of Shewchuk\'s Triangle' -r -F
complete -c incircle -n "__fish_incircle_using_subcommand triangulate" -l neighbors -d 'Write the neighbours of the triangles into this file as well, in the format .neigh' -r -F
complete -c incircle -n "__fish_incircle_using_subcommand triangulate" -l memory -d 'Memory that the run may take, from 32M on, such as 300M or 2G: the set is cut into tiles' -r
complete -c incircle -n "__fish_incircle_using_subcommand triangulate" -l scratch -d 'Folder for the files of a set in tiles (default: the folder of the mesh)' -r -F
complete -c incircle -n "__fish_incircle_using_subcommand triangulate" -l trace -d 'Record a waveform of the back end \'sim\' in this file, for small sets' -r -F
complete -c incircle -n "__fish_incircle_using_subcommand triangulate" -l trace-job -d 'Record this job alone, the first being 1; a set in parts has several' -r
complete -c incircle -n "__fish_incircle_using_subcommand triangulate" -l resume -d 'Go on with the files of a run that did not end'
complete -c incircle -n "__fish_incircle_using_subcommand triangulate" -l unordered -d 'Write the triangles of a set in tiles as they come, which needs no sort: npy, csv and ele only'
complete -c incircle -n "__fish_incircle_using_subcommand triangulate" -l json -d 'Print a report of the run as one JSON object on standard output'
complete -c incircle -n "__fish_incircle_using_subcommand triangulate" -s q -l quiet -d 'Print only errors'
complete -c incircle -n "__fish_incircle_using_subcommand triangulate" -s v -l verbose -d 'Print times and counters as well'
complete -c incircle -n "__fish_incircle_using_subcommand triangulate" -s h -l help -d 'Print help (see more with \'--help\')'
complete -c incircle -n "__fish_incircle_using_subcommand verify" -l from -d 'Point format' -r -f -a "csv\t'Rows `x,y`, header optional'
xyz\t'Rows `x y [z]`'
node\t'Shewchuk\'s Triangle, .node'
poly\t'Shewchuk\'s Triangle, .poly: points and constraints'
obj\t'Vertices of a Wavefront OBJ'
ply\t'Vertices of a PLY, ascii or binary'
geojson\t'Points of GeoJSON'
json\t'The list `points` of a JSON mesh, or GeoJSON'
las\t'LAS, LAZ or COPC, from laser scanners'
npy\t'An array of NumPy, of shape (n, 2) or (n, 3)'
npz\t'An archive of arrays of NumPy; see --array'
wkt\t'Points of WKT (well-known text)'"
complete -c incircle -n "__fish_incircle_using_subcommand verify" -l class -d 'Take only LiDAR points of these classes, such as 2,9: whole numbers from 0 to 255' -r
complete -c incircle -n "__fish_incircle_using_subcommand verify" -l bounds -d 'Take only LiDAR points in this rectangle, edges included: \'X0,Y0,X1,Y1\'' -r
complete -c incircle -n "__fish_incircle_using_subcommand verify" -l array -d 'Array of points in an .npz archive (default: the only array)' -r
complete -c incircle -n "__fish_incircle_using_subcommand verify" -l constraints -d 'Edges that must be in the mesh: a CSV file of pairs of point indices, counted from 0' -r -F
complete -c incircle -n "__fish_incircle_using_subcommand verify" -l domain -d 'Triangles that are wanted' -r -f -a "all\t'All triangles of the hull'
holes\t'Triangles that constraints separate from the outside and from all holes'
even-odd\t'Triangles that an odd number of rings surround'
non-zero\t'Triangles that rings run around more often in one direction than in the other'"
complete -c incircle -n "__fish_incircle_using_subcommand verify" -l crossings -d 'Treatment of constraints that cross' -r -f -a "reject\t'Crossings are an error, whose message has the place'
snap\t'Crossings become points, rounded to a grid 256 times finer'"
complete -c incircle -n "__fish_incircle_using_subcommand verify" -l format -d 'Mesh format' -r -f -a "ele\t'Shewchuk\'s Triangle, .ele: `N 3 0`, then `id a b c`, counted from 0'
obj\t'Wavefront OBJ'
ply\t'PLY, ascii'
ply-binary\t'PLY, binary: doubles, little endian'
json\t'Points, triangles, hull and duplicates'
csv\t'Rows `a,b,c`'
npy\t'An array of NumPy, of shape (m, 3) and type u4'"
complete -c incircle -n "__fish_incircle_using_subcommand verify" -l coord-bits -d 'Bits of a coordinate of the grid of --quantize, 8 to 31 (default: 31, or 16 for a core)' -r
complete -c incircle -n "__fish_incircle_using_subcommand verify" -l quantize -d 'Round the points onto a grid: \'fit\', \'SCALE\' or \'SCALE,X0,Y0\'' -r
complete -c incircle -n "__fish_incircle_using_subcommand verify" -l memory -d 'Memory that the check may take, from 32M on, such as 300M or 2G: the rest lies in files' -r
complete -c incircle -n "__fish_incircle_using_subcommand verify" -l scratch -d 'Folder for the files of a check with --memory (default: the folder of the mesh)' -r -F
complete -c incircle -n "__fish_incircle_using_subcommand verify" -l script -d 'POINTS is a script of \'replay\': check the mesh of the points that live at its end'
complete -c incircle -n "__fish_incircle_using_subcommand verify" -l unordered -d 'Take the triangles in any order, as \'triangulate --unordered\' writes them'
complete -c incircle -n "__fish_incircle_using_subcommand verify" -l json -d 'Print the result as one JSON object on standard output'
complete -c incircle -n "__fish_incircle_using_subcommand verify" -s q -l quiet -d 'Print only errors'
complete -c incircle -n "__fish_incircle_using_subcommand verify" -s h -l help -d 'Print help (see more with \'--help\')'
complete -c incircle -n "__fish_incircle_using_subcommand generate" -s n -d 'Number of points; in a script, of those that live at a time' -r
complete -c incircle -n "__fish_incircle_using_subcommand generate" -l numbers -d 'Kind of numbers of the coordinates' -r -f -a "whole\t'Whole numbers from 0 to 2^BITS - 1'
signed\t'The points of \'whole\', moved: from -2^(BITS-1) to 2^(BITS-1) - 1'
decimal\t'Decimals with six digits: the numbers of \'signed\' in steps of 0.000001'
double\t'Doubles between -1 and 1 with mantissas of 53 bits'
f32\t'Numbers that are exactly an f32: \'signed\' in steps of 2^-(BITS-1), from -1 to 1'"
complete -c incircle -n "__fish_incircle_using_subcommand generate" -l bits -d 'Bits of a coordinate, counted in steps, 1 to 31 (default: 16; for decimal 28, for f32 24)' -r
complete -c incircle -n "__fish_incircle_using_subcommand generate" -l seed -d 'Seed; one seed gives the same points on every machine' -r
complete -c incircle -n "__fish_incircle_using_subcommand generate" -l frames -d 'Frames of \'drift\' and \'tracks\' (default: 60)' -r
complete -c incircle -n "__fish_incircle_using_subcommand generate" -l commands -d 'Commands of \'churn\' (default: 20 for each point)' -r
complete -c incircle -n "__fish_incircle_using_subcommand generate" -l order -d 'Insertion order' -r -f -a "brio-hilbert\t''
hilbert\t''
input\t''
random\t''"
complete -c incircle -n "__fish_incircle_using_subcommand generate" -s o -l output -d 'File for the points: .csv, .xyz, .node or .npy; \'-\' is CSV on standard output' -r -F
complete -c incircle -n "__fish_incircle_using_subcommand generate" -l format -d 'Point format' -r -f -a "csv\t'Rows `x,y`'
xyz\t'Rows `x y`'
node\t'Shewchuk\'s Triangle, .node'
npy\t'An array of NumPy with n rows and two columns, .npy'"
complete -c incircle -n "__fish_incircle_using_subcommand generate" -s h -l help -d 'Print help (see more with \'--help\')'
complete -c incircle -n "__fish_incircle_using_subcommand bench" -s n -d 'Points of a set, including duplicates, which are then removed' -r
complete -c incircle -n "__fish_incircle_using_subcommand bench" -l batch -d 'Triangulate JOBS generated sets, 1 to 1,000,000, each with its own seed, as one batch' -r
complete -c incircle -n "__fish_incircle_using_subcommand bench" -l coord-bits -d 'Bits of a coordinate, 1 to 31 (default: 16)' -r
complete -c incircle -n "__fish_incircle_using_subcommand bench" -l seed -d 'Seed; one seed gives the same points on every machine' -r
complete -c incircle -n "__fish_incircle_using_subcommand bench" -l backend -d 'Back end' -r -f -a "cpu\t''
model\t''
clock\t''
sim\t''
serial:PORT\t''
udp:HOST\t''
pcie:N\t''"
complete -c incircle -n "__fish_incircle_using_subcommand bench" -l threads -d 'Threads of the back end \'cpu\' (default: one per processor)' -r
complete -c incircle -n "__fish_incircle_using_subcommand bench" -l config -d 'Core of \'clock\' and \'sim\'' -r -f -a "tiny\t'8 points, 2 contexts'
small\t'1024 points, 16 contexts'
full\t'8192 points, 16 contexts'
large\t'16384 points, 24 contexts'
dual\t'2 engines, each with 4096 points, 16 contexts'
quad\t'4 engines, each with 2048 points, 16 contexts'"
complete -c incircle -n "__fish_incircle_using_subcommand bench" -l contexts -d 'Insertions in flight at once (default: all contexts of the back end)' -r
complete -c incircle -n "__fish_incircle_using_subcommand bench" -l order -d 'Insertion order' -r -f -a "brio-hilbert\t''
hilbert\t''
input\t''
random\t''"
complete -c incircle -n "__fish_incircle_using_subcommand bench" -l timeout -d 'Seconds that a job may take (default: 60, and 0.002 for each point)' -r
complete -c incircle -n "__fish_incircle_using_subcommand bench" -l mhz -d 'Clock frequency in MHz for times (default: the board\'s, or 125)' -r
complete -c incircle -n "__fish_incircle_using_subcommand bench" -l json -d 'Print all rows as one JSON object on standard output'
complete -c incircle -n "__fish_incircle_using_subcommand bench" -s h -l help -d 'Print help (see more with \'--help\')'
complete -c incircle -n "__fish_incircle_using_subcommand tile; and not __fish_seen_subcommand_from split local join help" -s h -l help -d 'Print help (see more with \'--help\')'
complete -c incircle -n "__fish_incircle_using_subcommand tile; and not __fish_seen_subcommand_from split local join help" -f -a "split" -d 'Cut a set into tiles, with one file for each'
complete -c incircle -n "__fish_incircle_using_subcommand tile; and not __fish_seen_subcommand_from split local join help" -f -a "local" -d 'Triangulate one tile'
complete -c incircle -n "__fish_incircle_using_subcommand tile; and not __fish_seen_subcommand_from split local join help" -f -a "join" -d 'Join all tiles to one mesh'
complete -c incircle -n "__fish_incircle_using_subcommand tile; and not __fish_seen_subcommand_from split local join help" -f -a "help" -d 'Print this message or the help of the given subcommand(s)'
complete -c incircle -n "__fish_incircle_using_subcommand tile; and __fish_seen_subcommand_from split" -l points -d 'Most points of a tile' -r
complete -c incircle -n "__fish_incircle_using_subcommand tile; and __fish_seen_subcommand_from split" -s o -l output -d 'Folder for the tiles, which is made if it does not exist' -r -F
complete -c incircle -n "__fish_incircle_using_subcommand tile; and __fish_seen_subcommand_from split" -l from -d 'Point format' -r -f -a "csv\t'Rows `x,y`, header optional'
xyz\t'Rows `x y [z]`'
node\t'Shewchuk\'s Triangle, .node'
poly\t'Shewchuk\'s Triangle, .poly: points and constraints'
obj\t'Vertices of a Wavefront OBJ'
ply\t'Vertices of a PLY, ascii or binary'
geojson\t'Points of GeoJSON'
json\t'The list `points` of a JSON mesh, or GeoJSON'
las\t'LAS, LAZ or COPC, from laser scanners'
npy\t'An array of NumPy, of shape (n, 2) or (n, 3)'
npz\t'An archive of arrays of NumPy; see --array'
wkt\t'Points of WKT (well-known text)'"
complete -c incircle -n "__fish_incircle_using_subcommand tile; and __fish_seen_subcommand_from split" -l class -d 'Take only LiDAR points of these classes, such as 2,9: whole numbers from 0 to 255' -r
complete -c incircle -n "__fish_incircle_using_subcommand tile; and __fish_seen_subcommand_from split" -l bounds -d 'Take only LiDAR points in this rectangle, edges included: \'X0,Y0,X1,Y1\'' -r
complete -c incircle -n "__fish_incircle_using_subcommand tile; and __fish_seen_subcommand_from split" -l array -d 'Array of points in an .npz archive (default: the only array)' -r
complete -c incircle -n "__fish_incircle_using_subcommand tile; and __fish_seen_subcommand_from split" -l json -d 'Print a report as one JSON object on standard output'
complete -c incircle -n "__fish_incircle_using_subcommand tile; and __fish_seen_subcommand_from split" -s q -l quiet -d 'Print only errors'
complete -c incircle -n "__fish_incircle_using_subcommand tile; and __fish_seen_subcommand_from split" -s h -l help -d 'Print help (see more with \'--help\')'
complete -c incircle -n "__fish_incircle_using_subcommand tile; and __fish_seen_subcommand_from local" -l backend -d 'Back end' -r -f -a "cpu\t''
model\t''
clock\t''
sim\t''
serial:PORT\t''
udp:HOST\t''
pcie:N\t''"
complete -c incircle -n "__fish_incircle_using_subcommand tile; and __fish_seen_subcommand_from local" -l threads -d 'Threads of the back end \'cpu\' (default: one per processor)' -r
complete -c incircle -n "__fish_incircle_using_subcommand tile; and __fish_seen_subcommand_from local" -l config -d 'Core of \'clock\' and \'sim\'' -r -f -a "tiny\t'8 points, 2 contexts'
small\t'1024 points, 16 contexts'
full\t'8192 points, 16 contexts'
large\t'16384 points, 24 contexts'
dual\t'2 engines, each with 4096 points, 16 contexts'
quad\t'4 engines, each with 2048 points, 16 contexts'"
complete -c incircle -n "__fish_incircle_using_subcommand tile; and __fish_seen_subcommand_from local" -l timeout -d 'Seconds that the tile may take (default: 60, and 0.002 for each point)' -r
complete -c incircle -n "__fish_incircle_using_subcommand tile; and __fish_seen_subcommand_from local" -l json -d 'Print a report as one JSON object on standard output'
complete -c incircle -n "__fish_incircle_using_subcommand tile; and __fish_seen_subcommand_from local" -s q -l quiet -d 'Print only errors'
complete -c incircle -n "__fish_incircle_using_subcommand tile; and __fish_seen_subcommand_from local" -s h -l help -d 'Print help (see more with \'--help\')'
complete -c incircle -n "__fish_incircle_using_subcommand tile; and __fish_seen_subcommand_from join" -s o -l output -d 'File for the mesh, in the format of its extension' -r -F
complete -c incircle -n "__fish_incircle_using_subcommand tile; and __fish_seen_subcommand_from join" -l format -d 'Mesh format' -r -f -a "ele\t'Shewchuk\'s Triangle, .ele: `N 3 0`, then `id a b c`, counted from 0'
obj\t'Wavefront OBJ'
ply\t'PLY, ascii'
ply-binary\t'PLY, binary: doubles, little endian'
vtk\t'Legacy VTK, ascii'
geojson\t'GeoJSON with a polygon for each triangle'
json\t'Points, triangles, hull and duplicates'
csv\t'Rows `a,b,c`'
npy\t'An array of NumPy, of shape (m, 3) and type u4'
svg\t'A picture'"
complete -c incircle -n "__fish_incircle_using_subcommand tile; and __fish_seen_subcommand_from join" -l memory -d 'Memory for triangles, such as 1G; borders come on top, and the rest is in the folder of the tiles' -r
complete -c incircle -n "__fish_incircle_using_subcommand tile; and __fish_seen_subcommand_from join" -l from -d 'Point format' -r -f -a "csv\t'Rows `x,y`, header optional'
xyz\t'Rows `x y [z]`'
node\t'Shewchuk\'s Triangle, .node'
poly\t'Shewchuk\'s Triangle, .poly: points and constraints'
obj\t'Vertices of a Wavefront OBJ'
ply\t'Vertices of a PLY, ascii or binary'
geojson\t'Points of GeoJSON'
json\t'The list `points` of a JSON mesh, or GeoJSON'
las\t'LAS, LAZ or COPC, from laser scanners'
npy\t'An array of NumPy, of shape (n, 2) or (n, 3)'
npz\t'An archive of arrays of NumPy; see --array'
wkt\t'Points of WKT (well-known text)'"
complete -c incircle -n "__fish_incircle_using_subcommand tile; and __fish_seen_subcommand_from join" -l class -d 'Take only LiDAR points of these classes, such as 2,9: whole numbers from 0 to 255' -r
complete -c incircle -n "__fish_incircle_using_subcommand tile; and __fish_seen_subcommand_from join" -l bounds -d 'Take only LiDAR points in this rectangle, edges included: \'X0,Y0,X1,Y1\'' -r
complete -c incircle -n "__fish_incircle_using_subcommand tile; and __fish_seen_subcommand_from join" -l array -d 'Array of points in an .npz archive (default: the only array)' -r
complete -c incircle -n "__fish_incircle_using_subcommand tile; and __fish_seen_subcommand_from join" -l unordered -d 'Write the triangles in the order of the tiles, which needs no sort: npy, csv and ele only'
complete -c incircle -n "__fish_incircle_using_subcommand tile; and __fish_seen_subcommand_from join" -l json -d 'Print a report as one JSON object on standard output'
complete -c incircle -n "__fish_incircle_using_subcommand tile; and __fish_seen_subcommand_from join" -s q -l quiet -d 'Print only errors'
complete -c incircle -n "__fish_incircle_using_subcommand tile; and __fish_seen_subcommand_from join" -s h -l help -d 'Print help (see more with \'--help\')'
complete -c incircle -n "__fish_incircle_using_subcommand tile; and __fish_seen_subcommand_from help" -f -a "split" -d 'Cut a set into tiles, with one file for each'
complete -c incircle -n "__fish_incircle_using_subcommand tile; and __fish_seen_subcommand_from help" -f -a "local" -d 'Triangulate one tile'
complete -c incircle -n "__fish_incircle_using_subcommand tile; and __fish_seen_subcommand_from help" -f -a "join" -d 'Join all tiles to one mesh'
complete -c incircle -n "__fish_incircle_using_subcommand tile; and __fish_seen_subcommand_from help" -f -a "help" -d 'Print this message or the help of the given subcommand(s)'
complete -c incircle -n "__fish_incircle_using_subcommand replay" -s o -l output -d 'File for the mesh at the end, in the format of its extension' -r -F
complete -c incircle -n "__fish_incircle_using_subcommand replay" -l format -d 'Mesh format' -r -f -a "ele\t'Shewchuk\'s Triangle, .ele: `N 3 0`, then `id a b c`, counted from 0'
obj\t'Wavefront OBJ'
ply\t'PLY, ascii'
ply-binary\t'PLY, binary: doubles, little endian'
vtk\t'Legacy VTK, ascii'
geojson\t'GeoJSON with a polygon for each triangle'
json\t'Points, triangles, hull and duplicates'
csv\t'Rows `a,b,c`'
npy\t'An array of NumPy, of shape (m, 3) and type u4'
svg\t'A picture'"
complete -c incircle -n "__fish_incircle_using_subcommand replay" -l answers -d 'File for the answers, a row for each question; \'-\' is standard output' -r -F
complete -c incircle -n "__fish_incircle_using_subcommand replay" -l film -d 'File for a film of the mesh: an animated SVG, for up to 2000 points at a time' -r -F
complete -c incircle -n "__fish_incircle_using_subcommand replay" -l frames -d 'Most frames of the film (default: 120)' -r
complete -c incircle -n "__fish_incircle_using_subcommand replay" -l backend -d 'Back end' -r -f -a "cpu\t''
model\t''
clock\t''
sim\t''
serial:PORT\t''
udp:HOST\t''
pcie:N\t''"
complete -c incircle -n "__fish_incircle_using_subcommand replay" -l threads -d 'Threads of the back end \'cpu\' (default: one per processor)' -r
complete -c incircle -n "__fish_incircle_using_subcommand replay" -l config -d 'Core of \'clock\' and \'sim\'' -r -f -a "tiny\t'8 points, 2 contexts'
small\t'1024 points, 16 contexts'
full\t'8192 points, 16 contexts'
large\t'16384 points, 24 contexts'
dual\t'2 engines, each with 4096 points, 16 contexts'
quad\t'4 engines, each with 2048 points, 16 contexts'"
complete -c incircle -n "__fish_incircle_using_subcommand replay" -l contexts -d 'Insertions in flight at once (default: all contexts of the back end)' -r
complete -c incircle -n "__fish_incircle_using_subcommand replay" -l order -d 'Insertion order' -r -f -a "brio-hilbert\t''
hilbert\t''
input\t''
random\t''"
complete -c incircle -n "__fish_incircle_using_subcommand replay" -l timeout -d 'Seconds that a job may take (default: 60, and 0.002 for each point)' -r
complete -c incircle -n "__fish_incircle_using_subcommand replay" -l json -d 'Print a report of the run as one JSON object on standard output'
complete -c incircle -n "__fish_incircle_using_subcommand replay" -s q -l quiet -d 'Print only errors'
complete -c incircle -n "__fish_incircle_using_subcommand replay" -s h -l help -d 'Print help (see more with \'--help\')'
complete -c incircle -n "__fish_incircle_using_subcommand voronoi" -s o -l output -d 'File for the cells: .geojson, .json or .svg; \'-\' is standard output and needs --format' -r -F
complete -c incircle -n "__fish_incircle_using_subcommand voronoi" -l format -d 'Format of the cells' -r -f -a "geojson\t'A feature for each cell, with its point, area and neighbours'
json\t'Cells by the numbers of their Voronoi vertices, or clipped cells with their corners'
svg\t'A picture'"
complete -c incircle -n "__fish_incircle_using_subcommand voronoi" -l clip -d 'Clip the cells to this rectangle: two opposite corners \'X0,Y0,X1,Y1\'' -r
complete -c incircle -n "__fish_incircle_using_subcommand voronoi" -l clip-to -d 'Clip the cells to the polygon in this file' -r -F
complete -c incircle -n "__fish_incircle_using_subcommand voronoi" -l from -d 'Point format' -r -f -a "csv\t'Rows `x,y`, header optional'
xyz\t'Rows `x y [z]`'
node\t'Shewchuk\'s Triangle, .node'
poly\t'Shewchuk\'s Triangle, .poly: points and constraints'
obj\t'Vertices of a Wavefront OBJ'
ply\t'Vertices of a PLY, ascii or binary'
geojson\t'Points of GeoJSON'
json\t'The list `points` of a JSON mesh, or GeoJSON'
las\t'LAS, LAZ or COPC, from laser scanners'
npy\t'An array of NumPy, of shape (n, 2) or (n, 3)'
npz\t'An archive of arrays of NumPy; see --array'
wkt\t'Points of WKT (well-known text)'"
complete -c incircle -n "__fish_incircle_using_subcommand voronoi" -l class -d 'Take only LiDAR points of these classes, such as 2,9: whole numbers from 0 to 255' -r
complete -c incircle -n "__fish_incircle_using_subcommand voronoi" -l bounds -d 'Take only LiDAR points in this rectangle, edges included: \'X0,Y0,X1,Y1\'' -r
complete -c incircle -n "__fish_incircle_using_subcommand voronoi" -l array -d 'Array of points in an .npz archive (default: the only array)' -r
complete -c incircle -n "__fish_incircle_using_subcommand voronoi" -l coord-bits -d 'Bits of a coordinate of the grid of --quantize, 8 to 31 (default: 31, or 16 for a core)' -r
complete -c incircle -n "__fish_incircle_using_subcommand voronoi" -l quantize -d 'Round the points onto a grid: \'fit\', \'SCALE\' or \'SCALE,X0,Y0\'' -r
complete -c incircle -n "__fish_incircle_using_subcommand voronoi" -l json -d 'Print a report of the run as one JSON object on standard output'
complete -c incircle -n "__fish_incircle_using_subcommand voronoi" -s q -l quiet -d 'Print only errors'
complete -c incircle -n "__fish_incircle_using_subcommand voronoi" -s h -l help -d 'Print help (see more with \'--help\')'
complete -c incircle -n "__fish_incircle_using_subcommand interpolate" -l value -d 'Column of a CSV file with the values: a name of its header, or a number from 1 on (default: z)' -r
complete -c incircle -n "__fish_incircle_using_subcommand interpolate" -l at -d 'File of the places at which values are wanted, in the format of its extension' -r -F
complete -c incircle -n "__fish_incircle_using_subcommand interpolate" -l grid -d 'Values at all multiples of this step within the box of the points' -r
complete -c incircle -n "__fish_incircle_using_subcommand interpolate" -l contours -d 'Lines of equal value instead of values: one for each multiple of this step' -r
complete -c incircle -n "__fish_incircle_using_subcommand interpolate" -s o -l output -d 'File for the values: .csv, .npy, .asc, .tif or .geojson; \'-\' is standard output and needs --format' -r -F
complete -c incircle -n "__fish_incircle_using_subcommand interpolate" -l format -d 'Format of the values' -r -f -a "csv\t'Rows x,y,value below a header, in the order of the places'
npy\t'An array of NumPy: the values in the order of the places, or rows of a grid from the lowest y'
asc\t'An ASCII grid of Esri, for --grid'
tif\t'A GeoTIFF of doubles, for --grid'
geojson\t'Lines, for --contours'"
complete -c incircle -n "__fish_incircle_using_subcommand interpolate" -l method -d 'Method by which values between points are made' -r -f -a "linear\t'The plane through the corners of the triangle'
laplace\t'Natural neighbours, weighted by edge length over distance'
sibson\t'Natural neighbours, weighted by area'"
complete -c incircle -n "__fish_incircle_using_subcommand interpolate" -l outside -d 'The value outside the hull of the points' -r -f -a "nan\t'No value: not a number (NaN)'
nearest\t'The value of the nearest point'"
complete -c incircle -n "__fish_incircle_using_subcommand interpolate" -l backend -d 'Back end that says in which triangle each place lies: \'cpu\' (default), \'model\' or \'clock\'' -r -f -a "cpu\t''
model\t''
clock\t''
sim\t''
serial:PORT\t''
udp:HOST\t''
pcie:N\t''"
complete -c incircle -n "__fish_incircle_using_subcommand interpolate" -l threads -d 'Threads (default: all processors); the values do not depend on them' -r
complete -c incircle -n "__fish_incircle_using_subcommand interpolate" -l from -d 'Point format' -r -f -a "csv\t'Rows `x,y`, header optional'
xyz\t'Rows `x y [z]`'
node\t'Shewchuk\'s Triangle, .node'
poly\t'Shewchuk\'s Triangle, .poly: points and constraints'
obj\t'Vertices of a Wavefront OBJ'
ply\t'Vertices of a PLY, ascii or binary'
geojson\t'Points of GeoJSON'
json\t'The list `points` of a JSON mesh, or GeoJSON'
las\t'LAS, LAZ or COPC, from laser scanners'
npy\t'An array of NumPy, of shape (n, 2) or (n, 3)'
npz\t'An archive of arrays of NumPy; see --array'
wkt\t'Points of WKT (well-known text)'"
complete -c incircle -n "__fish_incircle_using_subcommand interpolate" -l class -d 'Take only LiDAR points of these classes, such as 2,9: whole numbers from 0 to 255' -r
complete -c incircle -n "__fish_incircle_using_subcommand interpolate" -l bounds -d 'Take only LiDAR points in this rectangle, edges included: \'X0,Y0,X1,Y1\'' -r
complete -c incircle -n "__fish_incircle_using_subcommand interpolate" -l array -d 'Array of points in an .npz archive (default: the only array)' -r
complete -c incircle -n "__fish_incircle_using_subcommand interpolate" -l json -d 'Print a report of the run as one JSON object on standard output'
complete -c incircle -n "__fish_incircle_using_subcommand interpolate" -s q -l quiet -d 'Print only errors'
complete -c incircle -n "__fish_incircle_using_subcommand interpolate" -s h -l help -d 'Print help (see more with \'--help\')'
complete -c incircle -n "__fish_incircle_using_subcommand lloyd" -s o -l output -d 'File for the points at their new places, in their order: .csv, .xyz, .node or .npy' -r -F
complete -c incircle -n "__fish_incircle_using_subcommand lloyd" -l format -d 'Format of the new points' -r -f -a "csv\t'Rows `x,y`'
xyz\t'Rows `x y`'
node\t'Shewchuk\'s Triangle, .node'
npy\t'An array of NumPy with n rows and two columns, .npy'"
complete -c incircle -n "__fish_incircle_using_subcommand lloyd" -l iterations -d 'The most steps: in each, every point moves to the centroid of its cell' -r
complete -c incircle -n "__fish_incircle_using_subcommand lloyd" -l clip -d 'Clip the cells to this rectangle: two opposite corners \'X0,Y0,X1,Y1\' (default: around the points)' -r
complete -c incircle -n "__fish_incircle_using_subcommand lloyd" -l clip-to -d 'Clip the cells to the polygon in this file' -r -F
complete -c incircle -n "__fish_incircle_using_subcommand lloyd" -l density -d 'Let points gather where this image is dark: a PNG, JPEG or PGM file' -r -F
complete -c incircle -n "__fish_incircle_using_subcommand lloyd" -l threads -d 'Threads (default: all processors); the places do not depend on them' -r
complete -c incircle -n "__fish_incircle_using_subcommand lloyd" -l from -d 'Point format' -r -f -a "csv\t'Rows `x,y`, header optional'
xyz\t'Rows `x y [z]`'
node\t'Shewchuk\'s Triangle, .node'
poly\t'Shewchuk\'s Triangle, .poly: points and constraints'
obj\t'Vertices of a Wavefront OBJ'
ply\t'Vertices of a PLY, ascii or binary'
geojson\t'Points of GeoJSON'
json\t'The list `points` of a JSON mesh, or GeoJSON'
las\t'LAS, LAZ or COPC, from laser scanners'
npy\t'An array of NumPy, of shape (n, 2) or (n, 3)'
npz\t'An archive of arrays of NumPy; see --array'
wkt\t'Points of WKT (well-known text)'"
complete -c incircle -n "__fish_incircle_using_subcommand lloyd" -l class -d 'Take only LiDAR points of these classes, such as 2,9: whole numbers from 0 to 255' -r
complete -c incircle -n "__fish_incircle_using_subcommand lloyd" -l bounds -d 'Take only LiDAR points in this rectangle, edges included: \'X0,Y0,X1,Y1\'' -r
complete -c incircle -n "__fish_incircle_using_subcommand lloyd" -l array -d 'Array of points in an .npz archive (default: the only array)' -r
complete -c incircle -n "__fish_incircle_using_subcommand lloyd" -l coord-bits -d 'Bits of a coordinate of the grid of --quantize, 8 to 31 (default: 31, or 16 for a core)' -r
complete -c incircle -n "__fish_incircle_using_subcommand lloyd" -l quantize -d 'Round the points onto a grid: \'fit\', \'SCALE\' or \'SCALE,X0,Y0\'' -r
complete -c incircle -n "__fish_incircle_using_subcommand lloyd" -l until-still -d 'Do steps until no point moves, or points go round, at most 100,000'
complete -c incircle -n "__fish_incircle_using_subcommand lloyd" -l json -d 'Print a report of the run as one JSON object on standard output'
complete -c incircle -n "__fish_incircle_using_subcommand lloyd" -s q -l quiet -d 'Print only errors'
complete -c incircle -n "__fish_incircle_using_subcommand lloyd" -s h -l help -d 'Print help (see more with \'--help\')'
complete -c incircle -n "__fish_incircle_using_subcommand info" -l backend -d 'Back end' -r -f -a "cpu\t''
model\t''
clock\t''
sim\t''
serial:PORT\t''
udp:HOST\t''
pcie:N\t''"
complete -c incircle -n "__fish_incircle_using_subcommand info" -l threads -d 'Threads of the back end \'cpu\' (default: one per processor)' -r
complete -c incircle -n "__fish_incircle_using_subcommand info" -l config -d 'Core of \'clock\' and \'sim\'' -r -f -a "tiny\t'8 points, 2 contexts'
small\t'1024 points, 16 contexts'
full\t'8192 points, 16 contexts'
large\t'16384 points, 24 contexts'
dual\t'2 engines, each with 4096 points, 16 contexts'
quad\t'4 engines, each with 2048 points, 16 contexts'"
complete -c incircle -n "__fish_incircle_using_subcommand info" -s p -l port -d 'Board at this serial port, the same as --backend serial:PORT' -r
complete -c incircle -n "__fish_incircle_using_subcommand info" -s h -l help -d 'Print help (see more with \'--help\')'
complete -c incircle -n "__fish_incircle_using_subcommand devices" -l network -d 'List the devices on the network instead: those that answer a greeting to all' -r
complete -c incircle -n "__fish_incircle_using_subcommand devices" -s g -l greet -d 'Ask at every port and card whether an incircle core is there'
complete -c incircle -n "__fish_incircle_using_subcommand devices" -s h -l help -d 'Print help (see more with \'--help\')'
complete -c incircle -n "__fish_incircle_using_subcommand completions" -s h -l help -d 'Print help (see more with \'--help\')'
complete -c incircle -n "__fish_incircle_using_subcommand man" -s h -l help -d 'Print help (see more with \'--help\')'
complete -c incircle -n "__fish_incircle_using_subcommand help; and not __fish_seen_subcommand_from triangulate verify generate bench tile replay voronoi interpolate lloyd info devices completions man help" -f -a "triangulate" -d 'Triangulate a file of points'
complete -c incircle -n "__fish_incircle_using_subcommand help; and not __fish_seen_subcommand_from triangulate verify generate bench tile replay voronoi interpolate lloyd info devices completions man help" -f -a "verify" -d 'Check that a mesh is the canonical Delaunay triangulation of its points'
complete -c incircle -n "__fish_incircle_using_subcommand help; and not __fish_seen_subcommand_from triangulate verify generate bench tile replay voronoi interpolate lloyd info devices completions man help" -f -a "generate" -d 'Make a set of points, or a script for \'replay\''
complete -c incircle -n "__fish_incircle_using_subcommand help; and not __fish_seen_subcommand_from triangulate verify generate bench tile replay voronoi interpolate lloyd info devices completions man help" -f -a "bench" -d 'Measure a back end on generated sets, with a row of a table for each set'
complete -c incircle -n "__fish_incircle_using_subcommand help; and not __fish_seen_subcommand_from triangulate verify generate bench tile replay voronoi interpolate lloyd info devices completions man help" -f -a "tile" -d 'Triangulate a set in tiles over files: larger than the memory, or on many machines'
complete -c incircle -n "__fish_incircle_using_subcommand help; and not __fish_seen_subcommand_from triangulate verify generate bench tile replay voronoi interpolate lloyd info devices completions man help" -f -a "replay" -d 'Carry out a script of changes and questions on a mesh that lives'
complete -c incircle -n "__fish_incircle_using_subcommand help; and not __fish_seen_subcommand_from triangulate verify generate bench tile replay voronoi interpolate lloyd info devices completions man help" -f -a "voronoi" -d 'Compute the Voronoi cells of a file of points, exactly'
complete -c incircle -n "__fish_incircle_using_subcommand help; and not __fish_seen_subcommand_from triangulate verify generate bench tile replay voronoi interpolate lloyd info devices completions man help" -f -a "interpolate" -d 'Work out values between points, such as heights: at places of a file, or on a grid'
complete -c incircle -n "__fish_incircle_using_subcommand help; and not __fish_seen_subcommand_from triangulate verify generate bench tile replay voronoi interpolate lloyd info devices completions man help" -f -a "lloyd" -d 'Spread points evenly: move each to the centroid of its Voronoi cell, again and again'
complete -c incircle -n "__fish_incircle_using_subcommand help; and not __fish_seen_subcommand_from triangulate verify generate bench tile replay voronoi interpolate lloyd info devices completions man help" -f -a "info" -d 'Describe a back end: version, coordinates, capacity, contexts'
complete -c incircle -n "__fish_incircle_using_subcommand help; and not __fish_seen_subcommand_from triangulate verify generate bench tile replay voronoi interpolate lloyd info devices completions man help" -f -a "devices" -d 'List the serial ports and the PCIe cards of this machine, or the devices on the network'
complete -c incircle -n "__fish_incircle_using_subcommand help; and not __fish_seen_subcommand_from triangulate verify generate bench tile replay voronoi interpolate lloyd info devices completions man help" -f -a "completions" -d 'Print a completion script for a shell'
complete -c incircle -n "__fish_incircle_using_subcommand help; and not __fish_seen_subcommand_from triangulate verify generate bench tile replay voronoi interpolate lloyd info devices completions man help" -f -a "man" -d 'Print a page for \'man\', of the command or of a subcommand'
complete -c incircle -n "__fish_incircle_using_subcommand help; and not __fish_seen_subcommand_from triangulate verify generate bench tile replay voronoi interpolate lloyd info devices completions man help" -f -a "help" -d 'Print this message or the help of the given subcommand(s)'
complete -c incircle -n "__fish_incircle_using_subcommand help; and __fish_seen_subcommand_from tile" -f -a "split" -d 'Cut a set into tiles, with one file for each'
complete -c incircle -n "__fish_incircle_using_subcommand help; and __fish_seen_subcommand_from tile" -f -a "local" -d 'Triangulate one tile'
complete -c incircle -n "__fish_incircle_using_subcommand help; and __fish_seen_subcommand_from tile" -f -a "join" -d 'Join all tiles to one mesh'
