//! The language of scenes: shapes, aims, repeated elements, starts by joint coordinates.

mod include;
mod repeat;
mod shapes;
mod start;
mod urdf;
