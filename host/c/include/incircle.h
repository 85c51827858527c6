/* The C interface of incircle, made of the Rust sources by cbindgen. A test compares it with them.
 *
 * Each function returns INCIRCLE_OK or another status, and incircle_error() then has a sentence about it. */


#ifndef INCIRCLE_H
#define INCIRCLE_H

#include <stdarg.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>

// The number of this interface. It changes when a program must be compiled again.
#define INCIRCLE_ABI 1

// The call did what it says.
#define INCIRCLE_OK 0

// A pointer is null or not aligned where that is not allowed, or a number that stands for a type is none.
#define INCIRCLE_ARGUMENT 1

// The points cannot be used as they are.
#define INCIRCLE_INPUT 2

// A choice is impossible, such as threads for a device.
#define INCIRCLE_CHOICE 3

// There is no device at the address, or it cannot be opened.
#define INCIRCLE_DEVICE_NOT_FOUND 4

// Words did not get through between the host and the device.
#define INCIRCLE_LINK 5

// The device gave an answer that no sound device gives.
#define INCIRCLE_DEVICE 6

// The device did not answer in time.
#define INCIRCLE_TIMEOUT 7

// There are more points than indices allow.
#define INCIRCLE_CAPACITY 8

// The function that hears of the progress ended the job.
#define INCIRCLE_CANCELLED 9

// There is not enough memory.
#define INCIRCLE_MEMORY 10

// No living point has the index.
#define INCIRCLE_INDEX 11

// The buffer is too small. The count says how many items it needs.
#define INCIRCLE_BUFFER 12

// The mesh is not the canonical one of its points.
#define INCIRCLE_WRONG_MESH 13

// The library has a defect: please report it.
#define INCIRCLE_DEFECT 14

// Coordinates are `double`.
#define INCIRCLE_F64 0

// Coordinates are `float`.
#define INCIRCLE_F32 1

// Coordinates are `int64_t`.
#define INCIRCLE_I64 2

// Coordinates are `int32_t`.
#define INCIRCLE_I32 3

// Coordinates are `uint32_t`.
#define INCIRCLE_U32 4

// All triangles of the hull.
#define INCIRCLE_ALL 0

// The triangles that constraints separate from the outside of the hull and from all holes.
#define INCIRCLE_HOLES 1

// The triangles that an odd number of rings of constraints surround.
#define INCIRCLE_EVEN_ODD 2

// The triangles around which the rings of constraints run a number of times that is not zero.
#define INCIRCLE_NON_ZERO 3

// The place is none: there are no triangles and it lies on no edge, or a coordinate is NaN or infinite.
#define INCIRCLE_NONE 0

// The place has a point.
#define INCIRCLE_VERTEX 1

// The place lies in an edge.
#define INCIRCLE_EDGE 2

// The place lies in a triangle.
#define INCIRCLE_TRIANGLE 3

// The place lies outside the hull.
#define INCIRCLE_OUTSIDE 4

// No index.
#define INCIRCLE_EMPTY UINT32_MAX

// Points and clip are taken exactly: they must lie on a lattice of few enough bits.
#define INCIRCLE_EXACT 0

// Points and clip are rounded onto a grid.
#define INCIRCLE_QUANTIZE 1

// All steps of a relaxation were done.
#define INCIRCLE_ITERATIONS 0

// No point moved in the last step of a relaxation.
#define INCIRCLE_STILL 1

// A state of a relaxation came again.
#define INCIRCLE_CYCLE 2

// The plane through the corners of the triangle around a place.
#define INCIRCLE_LINEAR 0

// Natural neighbours, weighted by lengths of edges over distances.
#define INCIRCLE_LAPLACE 1

// Natural neighbours, weighted by areas.
#define INCIRCLE_SIBSON 2

// Outside the hull, there is no value: the result is NaN.
#define INCIRCLE_NAN 0

// Outside the hull, the value is that of the nearest point.
#define INCIRCLE_NEAREST 1

// The triangles of a domain in the canonical mesh with constraints. Several threads may read one at a time.
typedef struct incircle_constrained incircle_constrained;

// The contour lines of a level. Several threads may read them at a time.
typedef struct incircle_contours incircle_contours;

// The Voronoi diagram of a set of points. Several threads may read one at a time.
typedef struct incircle_diagram incircle_diagram;

// The mesh of a set of points. Several threads may read a mesh at a time.
typedef struct incircle_mesh incircle_mesh;

// Points with a value each, made ready for values elsewhere. Several threads may ask one at a time.
typedef struct incircle_surface incircle_surface;

// A triangulation that can be asked and changed. While one thread changes it, no other may use it; several may ask.
typedef struct incircle_triangulation incircle_triangulation;

// A function that hears of the progress of a job: the stage, and the items done of all items of the stage. It is
// called in the thread that asked for the job. A result other than 0 ends the job. No exception of C++ may leave it.
typedef int32_t (*incircle_progress)(void *user, const char *stage, size_t done, size_t total);

// The choices for a job. Set all to 0 and `size` to `sizeof(incircle_options)` first.
typedef struct {
  // The size of this structure in bytes.
  size_t size;
  // The address of what does the job, such as `"model"`; null for the CPU triangulator.
  const char *backend;
  // The most threads of the CPU triangulator, 1 to 256; 0 for one a processor.
  uint32_t threads;
  // The function that hears of the progress, or null.
  incircle_progress progress;
  // A pointer that every call of `progress` gets as its argument `user`.
  void *user;
} incircle_options;

// Constraints and the domain that is wanted. Set all to 0 and `size` to `sizeof(incircle_plan)` first.
typedef struct {
  // The size of this structure in bytes.
  size_t size;
  // Edges that must be in the mesh: the indices of both ends of each. They may overlap, touch and pass through
  // points, but not cross elsewhere.
  const uint32_t (*constraints)[2];
  // The number of constraints.
  size_t constraint_count;
  // The number of constraints at the end that bound nothing: they are edges, but no parts of rings.
  size_t lines;
  // The triangles that are wanted: `INCIRCLE_ALL`, `INCIRCLE_HOLES`, `INCIRCLE_EVEN_ODD` or `INCIRCLE_NON_ZERO`.
  uint32_t domain;
  // x and y of a place in each hole of `INCIRCLE_HOLES`, in the type of numbers of the mesh.
  const void *holes;
  // The number of holes.
  size_t hole_count;
  // x and y of a place in each region whose number is wanted, in the type of numbers of the mesh.
  const void *regions;
  // The number of these places.
  size_t region_count;
} incircle_plan;

// What a place is, and the vertices there.
typedef struct {
  // `INCIRCLE_NONE`, `INCIRCLE_VERTEX`, `INCIRCLE_EDGE`, `INCIRCLE_TRIANGLE` or `INCIRCLE_OUTSIDE`.
  uint32_t kind;
  // The vertices there, and `INCIRCLE_EMPTY` where there are fewer than three. Those of a triangle are
  // counter-clockwise. Outside the hull they are the first hull edge, counter-clockwise, that is visible.
  uint32_t vertices[3];
} incircle_location;

// The choices for a relaxation. Set all to 0 and `size` to `sizeof(incircle_relaxation)` first.
typedef struct {
  // The size of this structure in bytes.
  size_t size;
  // The most steps, 1 or more. A relaxation ends earlier if no point moves.
  uint32_t iterations;
  // 1 to end also when a state comes again; else 0.
  uint32_t until_still;
  // The most threads; 0 for one a processor.
  uint32_t threads;
  // `INCIRCLE_EXACT`, or `INCIRCLE_QUANTIZE` to round onto a grid of 23 bits first.
  uint32_t quantize;
  // x and y of the corners of the region to fill, in the type of numbers of the points: two opposite ones of a
  // rectangle, or three or more of a simple polygon. Null stands for the smallest rectangle around the points.
  const void *clip;
  // The number of these corners.
  size_t corner_count;
  // How many of the corners each ring has, if the clip is a polygon with holes: that around the polygon, then those
  // of the holes, as for `incircle_diagram_new_with_holes`. Null stands for a clip without holes.
  const size_t *ring_counts;
  // The number of rings, or 0.
  size_t ring_count;
  // How densely points are to lie: `rows` rows of `columns` weights, stretched over the smallest rectangle around
  // the clip, with the first row at the largest y as in images. A point moves to the centre of mass of its cell.
  // Null stands for the same weight everywhere.
  const uint16_t *density;
  // Weights in a row.
  size_t columns;
  // Rows of weights.
  size_t rows;
} incircle_relaxation;

// The outcome of a relaxation.
typedef struct {
  // The steps that were done.
  uint32_t iterations;
  // The reason why the relaxation ended: `INCIRCLE_ITERATIONS`, `INCIRCLE_STILL` or `INCIRCLE_CYCLE`.
  uint32_t end;
  // The number of points that moved in the last step.
  size_t moved;
  // The farthest that `INCIRCLE_QUANTIZE` moved a point along an axis; 0 if nothing was rounded.
  double largest_error;
} incircle_relaxed;

#ifdef __cplusplus
extern "C" {
#endif // __cplusplus

// The number of the interface of the library that is loaded: compare it with `INCIRCLE_ABI`.
uint32_t incircle_abi(void);

// Writes the sentence about the last call that failed in this thread, with a zero at its end, and cuts it off if the
// buffer is too small. Returns how many bytes the whole sentence needs, the zero included. `text` may be null if
// `room` is 0.
//
// # Safety
// `text` points to `room` bytes that may be written.
size_t incircle_error(char *text,
                      size_t room);

// Triangulates `count` points. `points` has x and y of each, in the type of numbers `number`, such as `INCIRCLE_F64`.
// `options` may be null. `mesh` becomes a mesh that must be freed, or null if the call fails.
//
// The points are copied, so they need to live only for the call. The status is `INCIRCLE_INPUT` for a coordinate that
// is NaN or infinite, and for points that the device cannot take.
//
// # Safety
// All pointers are null or point to what is said above.
int32_t incircle_triangulate(const void *points,
                             size_t count,
                             uint32_t number,
                             const incircle_options *options,
                             incircle_mesh **mesh);

// The triangles: three indices each, counter-clockwise, the smallest first, in sorted order.
//
// As in all functions for lists, `count` becomes the number of items. With a null buffer nothing else is done; else
// the buffer gets all items, or none and the status is `INCIRCLE_BUFFER`, if `room` items are not enough.
//
// # Safety
// `mesh` is a mesh that is not freed, `buffer` null or room for `room` items, and `count` may be written.
int32_t incircle_mesh_triangles(const incircle_mesh *mesh,
                                uint32_t (*buffer)[3],
                                size_t room,
                                size_t *count);

// The points on the hull, counter-clockwise, those in the middle of a hull edge included. A mesh without triangles
// lists all distinct points, in lexicographic order.
//
// # Safety
// As for `incircle_mesh_triangles`.
int32_t incircle_mesh_hull(const incircle_mesh *mesh,
                           uint32_t *buffer,
                           size_t room,
                           size_t *count);

// The points with the coordinates of an earlier one: the index of each, and the lowest index at its place.
//
// # Safety
// As for `incircle_mesh_triangles`.
int32_t incircle_mesh_duplicates(const incircle_mesh *mesh,
                                 uint32_t (*buffer)[2],
                                 size_t room,
                                 size_t *count);

// The half-edges, three for each triangle. Half-edge `3 t + k` runs from vertex `k` of triangle `t` to the next one.
// The item is the half-edge of the same edge in the other triangle, or `UINT32_MAX` on the hull.
//
// # Safety
// As for `incircle_mesh_triangles`.
int32_t incircle_mesh_halfedges(const incircle_mesh *mesh,
                                uint32_t *buffer,
                                size_t room,
                                size_t *count);

// Proves with the independent validator that this is the canonical mesh of its points. The status is
// `INCIRCLE_WRONG_MESH` if it is not.
//
// # Safety
// `mesh` is a mesh that is not freed.
int32_t incircle_mesh_verify(const incircle_mesh *mesh);

// Frees a mesh. A null pointer is allowed.
//
// # Safety
// `mesh` is null, or a mesh that is not freed, and is not used again.
void incircle_mesh_free(incircle_mesh *mesh);

// Forces constraints into a mesh and takes the triangles of a domain. The mesh stays as it is. `made` becomes a
// constrained mesh that must be freed, or null if the call fails.
//
// The status is `INCIRCLE_INPUT` for constraints that cross or name points that do not exist, a boundary that is not
// closed, a hole or region outside the hull or on a constraint, and a domain without triangles.
//
// # Safety
// `mesh` is a mesh that is not freed, `plan` points to a plan whose pointers are as described there, and `made` to a
// pointer that may be written.
int32_t incircle_constrain(const incircle_mesh *mesh,
                           const incircle_plan *plan,
                           incircle_constrained **made);

// The triangles of the domain: three indices each, in the form of `incircle_mesh_triangles`.
//
// # Safety
// `constrained` is one that is not freed; the rest is as for `incircle_mesh_triangles`.
int32_t incircle_constrained_triangles(const incircle_constrained *constrained,
                                       uint32_t (*buffer)[3],
                                       size_t room,
                                       size_t *count);

// The region of each triangle: a part of the domain that no constraint cuts. With `INCIRCLE_ALL` and without places of
// regions, every triangle is in region 0.
//
// # Safety
// As for `incircle_constrained_triangles`.
int32_t incircle_constrained_regions(const incircle_constrained *constrained,
                                     uint32_t *buffer,
                                     size_t room,
                                     size_t *count);

// The region around each place of the plan's `regions`.
//
// # Safety
// As for `incircle_constrained_triangles`.
int32_t incircle_constrained_marked(const incircle_constrained *constrained,
                                    uint32_t *buffer,
                                    size_t room,
                                    size_t *count);

// The edges that constraints fix, also those outside the domain: two indices each, the smaller first, in sorted order.
//
// # Safety
// As for `incircle_constrained_triangles`.
int32_t incircle_constrained_pieces(const incircle_constrained *constrained,
                                    uint32_t (*buffer)[2],
                                    size_t room,
                                    size_t *count);

// The place in `incircle_constrained_piece_constraints` at which the constraints of each piece begin. There is one
// item more than pieces: the end of the last.
//
// # Safety
// As for `incircle_constrained_triangles`.
int32_t incircle_constrained_piece_starts(const incircle_constrained *constrained,
                                          size_t *buffer,
                                          size_t room,
                                          size_t *count);

// The numbers of the constraints that each piece belongs to, one piece behind the other.
//
// # Safety
// As for `incircle_constrained_triangles`.
int32_t incircle_constrained_piece_constraints(const incircle_constrained *constrained,
                                               uint32_t *buffer,
                                               size_t room,
                                               size_t *count);

// Proves with the independent validator that these are the triangles of the plan's domain in the canonical mesh of the
// points of `mesh`. The status is `INCIRCLE_WRONG_MESH` if they are not. `mesh` may be null if `constrained` came from
// `incircle_triangulate_constrained`, which keeps the points.
//
// # Safety
// The pointers are as for `incircle_constrain`, and `constrained` is one that is not freed.
int32_t incircle_constrained_verify(const incircle_constrained *constrained,
                                    const incircle_mesh *mesh,
                                    const incircle_plan *plan);

// Frees a constrained mesh. A null pointer is allowed.
//
// # Safety
// `constrained` is null, or one that is not freed, and is not used again.
void incircle_constrained_free(incircle_constrained *constrained);

// Triangulates `count` points with the constraints of a plan, and takes the triangles of a domain. `points` has x and
// y of each, in the type of numbers `number`, such as `INCIRCLE_F64`. `options` may be null. `made` becomes a
// constrained mesh that must be freed, or null if the call fails.
//
// The triangles are those of `incircle_triangulate` and then `incircle_constrain`, byte for byte. This call takes less
// time with the CPU triangulator, whose progress is told while constraints are forced, too. The statuses are those of
// both functions. The points are copied, and kept for `incircle_constrained_verify`.
//
// # Safety
// All pointers are null or point to what is said above and in `incircle_plan`.
int32_t incircle_triangulate_constrained(const void *points,
                                         size_t count,
                                         uint32_t number,
                                         const incircle_options *options,
                                         const incircle_plan *plan,
                                         incircle_constrained **made);

// The points on the hull of all points, as in `incircle_mesh_hull`. The status is `INCIRCLE_CHOICE` if `constrained`
// came from `incircle_constrain`, whose mesh has them.
//
// # Safety
// As for `incircle_constrained_triangles`.
int32_t incircle_constrained_hull(const incircle_constrained *constrained,
                                  uint32_t *buffer,
                                  size_t room,
                                  size_t *count);

// The points with the coordinates of an earlier one, as in `incircle_mesh_duplicates`. The status is `INCIRCLE_CHOICE`
// if `constrained` came from `incircle_constrain`, whose mesh has them.
//
// # Safety
// As for `incircle_constrained_triangles`.
int32_t incircle_constrained_duplicates(const incircle_constrained *constrained,
                                        uint32_t (*buffer)[2],
                                        size_t room,
                                        size_t *count);

// Makes the triangulation of `count` points, whose indices are their positions. `points` may be null if `count` is 0.
// All coordinates that the triangulation takes have the type `number`, such as `INCIRCLE_F64`. `made` becomes a
// triangulation that must be freed, or null if the call fails.
//
// # Safety
// `points` points to `count` pairs of numbers of that type, and `made` to a pointer that may be written.
int32_t incircle_triangulation_new(const void *points,
                                   size_t count,
                                   uint32_t number,
                                   incircle_triangulation **made);

// Inserts the point at `place`, two coordinates, and gives its index. A point at the place of a living one is a
// duplicate, and no error.
//
// # Safety
// `triangulation` is one that is not freed, `place` points to two coordinates of its type, and `index` may be written.
int32_t incircle_triangulation_insert(incircle_triangulation *triangulation,
                                      const void *place,
                                      uint32_t *index);

// Deletes the point of an index. Other points at its place stay.
//
// # Safety
// `triangulation` is one that is not freed.
int32_t incircle_triangulation_delete(incircle_triangulation *triangulation, uint32_t index);

// Moves the point of an index to `place`. The point keeps its index.
//
// # Safety
// As for `incircle_triangulation_insert`.
int32_t incircle_triangulation_move(incircle_triangulation *triangulation,
                                    uint32_t index,
                                    const void *place);

// Moves all living points, given a place for each in the order of their indices. Short moves are quick.
//
// # Safety
// `triangulation` is one that is not freed, and `places` points to `count` pairs of coordinates of its type.
int32_t incircle_triangulation_move_all(incircle_triangulation *triangulation,
                                        const void *places,
                                        size_t count);

// Says what a place is: a vertex, in an edge, in a triangle, or outside the hull.
//
// # Safety
// `triangulation` is one that is not freed, `place` points to two coordinates of its type, and `location` may be
// written.
int32_t incircle_triangulation_locate(const incircle_triangulation *triangulation,
                                      const void *place,
                                      incircle_location *location);

// The index of the point nearest to a place; of points at the same distance the one with the smaller x, then y.
// `INCIRCLE_EMPTY` if there are no points, or if a coordinate is NaN or infinite.
//
// # Safety
// As for `incircle_triangulation_locate`.
int32_t incircle_triangulation_nearest(const incircle_triangulation *triangulation,
                                       const void *place,
                                       uint32_t *index);

// The vertices that have an edge to the place of a point, counter-clockwise.
//
// # Safety
// `triangulation` is one that is not freed; the rest is as for `incircle_mesh_triangles`.
int32_t incircle_triangulation_neighbors(const incircle_triangulation *triangulation,
                                         uint32_t index,
                                         uint32_t *buffer,
                                         size_t room,
                                         size_t *count);

// The indices of all living points, in rising order.
//
// # Safety
// `triangulation` is one that is not freed; the rest is as for `incircle_mesh_triangles`.
int32_t incircle_triangulation_indices(const incircle_triangulation *triangulation,
                                       uint32_t *buffer,
                                       size_t room,
                                       size_t *count);

// The canonical mesh of the living points. Index `k` in the mesh is that of the point whose index is item `k` of
// `incircle_triangulation_indices`. `mesh` becomes a mesh that must be freed, or null if the call fails.
//
// # Safety
// `triangulation` is one that is not freed, and `mesh` points to a pointer that may be written.
int32_t incircle_triangulation_mesh(const incircle_triangulation *triangulation,
                                    incircle_mesh **mesh);

// Frees a triangulation. A null pointer is allowed.
//
// # Safety
// `triangulation` is null, or one that is not freed, and is not used again.
void incircle_triangulation_free(incircle_triangulation *triangulation);

// The indices of the `number` places nearest to `place`, the nearest first; of places at the same distance, the one
// with the smaller x, then y, comes first. Fewer if there are fewer places; none if a coordinate is NaN or infinite. A
// call costs O(k log k) for `k` places, beside the search for the first.
//
// # Safety
// `triangulation` is one that is not freed, and `place` points to two coordinates of its type; the rest is as for
// `incircle_mesh_triangles`.
int32_t incircle_triangulation_k_nearest(const incircle_triangulation *triangulation,
                                         const void *place,
                                         size_t number,
                                         uint32_t *buffer,
                                         size_t room,
                                         size_t *count);

// The indices of the places at most `radius` from `center`, in rising order. No distance is rounded. None if the
// radius is negative or NaN, or if a coordinate is NaN or infinite.
//
// # Safety
// As for `incircle_triangulation_k_nearest`.
int32_t incircle_triangulation_within_circle(const incircle_triangulation *triangulation,
                                             const void *center,
                                             double radius,
                                             uint32_t *buffer,
                                             size_t room,
                                             size_t *count);

// The indices of the places in a rectangle or on its border, in rising order. Any two opposite corners name the
// rectangle. None if a coordinate is NaN or infinite.
//
// # Safety
// As for `incircle_triangulation_k_nearest`; each corner is two coordinates.
int32_t incircle_triangulation_within_rectangle(const incircle_triangulation *triangulation,
                                                const void *corner,
                                                const void *opposite,
                                                uint32_t *buffer,
                                                size_t room,
                                                size_t *count);

// The triangles whose inside the straight line between two places crosses, in that order; three indices each,
// counter-clockwise, the smallest first. A line along an edge crosses neither triangle beside it. None if a coordinate
// is NaN or infinite.
//
// # Safety
// As for `incircle_triangulation_k_nearest`; both ends are two coordinates.
int32_t incircle_triangulation_segment(const incircle_triangulation *triangulation,
                                       const void *from,
                                       const void *to,
                                       uint32_t (*buffer)[3],
                                       size_t room,
                                       size_t *count);

// The triangles around the place of a point, counter-clockwise, each with the lowest index of that place first.
//
// # Safety
// `triangulation` is one that is not freed; the rest is as for `incircle_mesh_triangles`.
int32_t incircle_triangulation_star(const incircle_triangulation *triangulation,
                                    uint32_t index,
                                    uint32_t (*buffer)[3],
                                    size_t room,
                                    size_t *count);

// Makes the Voronoi diagram of `count` points, and the cells inside a clip of `corner_count` corners: none, two
// opposite ones of a rectangle, or three or more of a simple polygon. `points` and `clip` have x and y of each, in the
// type of numbers `number`, such as `INCIRCLE_F64`. `diagram` becomes a diagram that must be freed, or null if the
// call fails.
//
// Points and clip must lie on a lattice of up to 31 bits, as whole numbers of that size do. Most doubles do not:
// `INCIRCLE_QUANTIZE` as `quantize` rounds them onto a grid, and `INCIRCLE_EXACT` refuses them. The status is
// `INCIRCLE_INPUT` for these, for a coordinate that is NaN or infinite, and for a clip without area or that crosses
// itself.
//
// # Safety
// `points` and `clip` point to as many pairs of numbers of that type, and `diagram` to a pointer that may be written.
int32_t incircle_diagram_new(const void *points,
                             size_t count,
                             const void *clip,
                             size_t corner_count,
                             uint32_t number,
                             uint32_t quantize,
                             incircle_diagram **diagram);

// As `incircle_diagram_new`, with a clip that may have holes. `clip` has the corners of all rings, one ring behind the
// other: that around the polygon, then those of the holes, which lie side by side inside it. `ring_counts` says how
// many corners each of the `ring_count` rings has, three or more. Rings may turn either way, and do not touch.
//
// The status is also `INCIRCLE_INPUT` for a hole that lies outside the polygon or inside another hole, and for rings
// that meet.
//
// # Safety
// `ring_counts` points to `ring_count` numbers, `clip` to as many pairs of numbers as they add up to; the rest is as
// for `incircle_diagram_new`.
int32_t incircle_diagram_new_with_holes(const void *points,
                                        size_t count,
                                        const void *clip,
                                        const size_t *ring_counts,
                                        size_t ring_count,
                                        uint32_t number,
                                        uint32_t quantize,
                                        incircle_diagram **diagram);

// The Voronoi vertices, all at different places: each coordinate is the double nearest to the exact one.
//
// # Safety
// `diagram` is one that is not freed; the rest is as for `incircle_mesh_triangles`.
int32_t incircle_diagram_vertices(const incircle_diagram *diagram,
                                  double (*buffer)[2],
                                  size_t room,
                                  size_t *count);

// Where the edges of the cell of each point begin in `incircle_diagram_neighbors` and `incircle_diagram_corners`.
// There is one item more than points: the end of the last. A duplicate has no edges.
//
// # Safety
// As for `incircle_diagram_vertices`.
int32_t incircle_diagram_starts(const incircle_diagram *diagram,
                                uint64_t *buffer,
                                size_t room,
                                size_t *count);

// The point on the other side of each edge, counter-clockwise around each cell.
//
// # Safety
// As for `incircle_diagram_vertices`.
int32_t incircle_diagram_neighbors(const incircle_diagram *diagram,
                                   uint32_t *buffer,
                                   size_t room,
                                   size_t *count);

// The Voronoi vertex at which each edge begins; `INCIRCLE_EMPTY` if the edge comes from infinity.
//
// # Safety
// As for `incircle_diagram_vertices`.
int32_t incircle_diagram_corners(const incircle_diagram *diagram,
                                 uint32_t *buffer,
                                 size_t room,
                                 size_t *count);

// The points with the coordinates of an earlier one: the index of each, and the lowest index at its place.
//
// # Safety
// As for `incircle_diagram_vertices`.
int32_t incircle_diagram_duplicates(const incircle_diagram *diagram,
                                    uint32_t (*buffer)[2],
                                    size_t room,
                                    size_t *count);

// The farthest that `INCIRCLE_QUANTIZE` moved a point along an axis; 0 if nothing was rounded.
//
// # Safety
// `diagram` is one that is not freed, and `error` may be written.
int32_t incircle_diagram_largest_error(const incircle_diagram *diagram, double *error);

// Frees a diagram. A null pointer is allowed.
//
// # Safety
// `diagram` is null, or one that is not freed, and is not used again.
void incircle_diagram_free(incircle_diagram *diagram);

// The corners of the rings of all cells inside the clip, one ring behind the other: counter-clockwise around a piece,
// clockwise around a hole in it. A cell has no piece, one, or several if the clip is not convex, and only a clip with
// holes has pieces with holes. The status is `INCIRCLE_CHOICE` if the diagram has no clip.
//
// # Safety
// As for `incircle_diagram_vertices`.
int32_t incircle_diagram_cell_corners(const incircle_diagram *diagram,
                                      double (*buffer)[2],
                                      size_t room,
                                      size_t *count);

// Where each ring begins in `incircle_diagram_cell_corners`. There is one item more than rings: the end of the last.
//
// # Safety
// As for `incircle_diagram_vertices`.
int32_t incircle_diagram_piece_starts(const incircle_diagram *diagram,
                                      uint64_t *buffer,
                                      size_t room,
                                      size_t *count);

// The point to which each ring belongs, in rising order.
//
// # Safety
// As for `incircle_diagram_vertices`.
int32_t incircle_diagram_piece_points(const incircle_diagram *diagram,
                                      uint32_t *buffer,
                                      size_t room,
                                      size_t *count);

// Whether each ring bounds a hole of the last piece before it: 1, or 0 for the ring around a piece.
//
// # Safety
// As for `incircle_diagram_vertices`.
int32_t incircle_diagram_ring_is_hole(const incircle_diagram *diagram,
                                      uint8_t *buffer,
                                      size_t room,
                                      size_t *count);

// The area of the cell of each point inside the clip; 0 for a duplicate.
//
// # Safety
// As for `incircle_diagram_vertices`.
int32_t incircle_diagram_areas(const incircle_diagram *diagram,
                               double *buffer,
                               size_t room,
                               size_t *count);

// The points whose cells share an edge inside the clip, one cell behind the other, each in rising order.
//
// # Safety
// As for `incircle_diagram_vertices`.
int32_t incircle_diagram_inside(const incircle_diagram *diagram,
                                uint32_t *buffer,
                                size_t room,
                                size_t *count);

// Where the items of each point begin in `incircle_diagram_inside`. There is one item more than points: the end of the
// last.
//
// # Safety
// As for `incircle_diagram_vertices`.
int32_t incircle_diagram_inside_starts(const incircle_diagram *diagram,
                                       uint64_t *buffer,
                                       size_t room,
                                       size_t *count);

// Spreads `count` points evenly: each step moves every point to the centroid of its Voronoi cell inside the clip of
// the choices. `points` has x and y of each, in the type of numbers `number`, such as `INCIRCLE_F64`. `places` gets
// the new place of each point, in their order; the places are the same bytes on every machine and with any number of
// threads. `relaxed` says what was done, and may be null.
//
// Points and clip must lie on a lattice of up to 23 bits, or are rounded onto one by `INCIRCLE_QUANTIZE`. The status
// is `INCIRCLE_INPUT` for points and clips that `incircle_diagram_new` refuses, for a rectangle around the points that
// has no area, for rings whose corners are not `corner_count`, and for a density without weights or whose weights are
// all 0. `places` has room for `room` points; with less room than points the status is `INCIRCLE_BUFFER`.
//
// # Safety
// The pointers of the choices are as described there, and the others point to what is said above.
int32_t incircle_lloyd(const void *points,
                       size_t count,
                       uint32_t number,
                       const incircle_relaxation *choices,
                       double (*places)[2],
                       size_t room,
                       incircle_relaxed *relaxed);

// Makes the surface of `count` points, x and y of each, with a value each. Of points at one place, the lowest index
// has the value. `surface` becomes a surface that must be freed, or null if the call fails.
//
// The status is `INCIRCLE_INPUT` for a coordinate or value that is NaN or infinite, and for points without a triangle.
//
// # Safety
// `points` points to `count` pairs, `values` to as many numbers, and `surface` to a pointer that may be written.
int32_t incircle_surface_new(const double (*points)[2],
                             const double *values,
                             size_t count,
                             incircle_surface **surface);

// The values at `count` places, x and y of each, in their order. `method` is `INCIRCLE_LINEAR`, `INCIRCLE_LAPLACE` or
// `INCIRCLE_SIBSON`, and `outside` is `INCIRCLE_NAN` or `INCIRCLE_NEAREST`. `threads` bounds the threads; 0 allows one
// a processor. A place that is not finite has no value.
//
// # Safety
// `surface` is one that is not freed, `places` points to `count` pairs, and `values` to as many numbers that may be
// written.
int32_t incircle_surface_values(const incircle_surface *surface,
                                uint32_t method,
                                uint32_t outside,
                                uint32_t threads,
                                const double (*places)[2],
                                size_t count,
                                double *values);

// Finds the contour lines of a level on the surface of `INCIRCLE_LINEAR`, with higher ground on their left. `contours`
// becomes a list of lines that must be freed, or null if the call fails.
//
// # Safety
// `surface` is one that is not freed, and `contours` points to a pointer that may be written.
int32_t incircle_surface_contours(const incircle_surface *surface,
                                  double level,
                                  incircle_contours **contours);

// The places at which the lines cross edges, one line behind the other. A closed line does not repeat its first place.
//
// # Safety
// `contours` is one that is not freed; the rest is as for `incircle_mesh_triangles`.
int32_t incircle_contours_places(const incircle_contours *contours,
                                 double (*buffer)[2],
                                 size_t room,
                                 size_t *count);

// The place in `incircle_contours_places` at which each line begins. There is one item more than lines: the end of the
// last.
//
// # Safety
// As for `incircle_contours_places`.
int32_t incircle_contours_starts(const incircle_contours *contours,
                                 size_t *buffer,
                                 size_t room,
                                 size_t *count);

// Whether each line is closed: 1, or 0 if it ends on the hull.
//
// # Safety
// As for `incircle_contours_places`.
int32_t incircle_contours_closed(const incircle_contours *contours,
                                 uint8_t *buffer,
                                 size_t room,
                                 size_t *count);

// Frees contour lines. A null pointer is allowed.
//
// # Safety
// `contours` is null, or one that is not freed, and is not used again.
void incircle_contours_free(incircle_contours *contours);

// Frees a surface. A null pointer is allowed.
//
// # Safety
// `surface` is null, or one that is not freed, and is not used again.
void incircle_surface_free(incircle_surface *surface);

#ifdef __cplusplus
}  // extern "C"
#endif  // __cplusplus

#endif  /* INCIRCLE_H */
