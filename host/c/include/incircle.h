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

// The mesh of a set of points. Several threads may read a mesh at a time.
typedef struct incircle_mesh incircle_mesh;

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
  // What is handed to that function.
  void *user;
} incircle_options;

// What a place is, and the vertices there.
typedef struct {
  // `INCIRCLE_NONE`, `INCIRCLE_VERTEX`, `INCIRCLE_EDGE`, `INCIRCLE_TRIANGLE` or `INCIRCLE_OUTSIDE`.
  uint32_t kind;
  // The vertices there, and `INCIRCLE_EMPTY` where there are fewer than three. Those of a triangle are
  // counter-clockwise. Outside the hull they are the first hull edge, counter-clockwise, that is visible.
  uint32_t vertices[3];
} incircle_location;

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

#ifdef __cplusplus
}  // extern "C"
#endif  // __cplusplus

#endif  /* INCIRCLE_H */
