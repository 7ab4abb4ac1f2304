//! The compute rasteriser covers what it must, exactly once, and draws what the GPU's own rasteriser draws.

mod agree;
mod coverage;
mod full_lists;
mod long_triangles;
mod planes;
mod plans;
mod print_sizes;
mod slabs;
mod solids;
mod touched;
mod ways;
