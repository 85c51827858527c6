//! Exact canonical Delaunay triangulation of integer points, in hardware or software.
