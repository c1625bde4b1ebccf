//! The language of scenes: shapes, aims, repeated elements, starts by joint coordinates.

mod include;
mod makers;
mod mjcf;
mod repeat;
mod shapes;
mod start;
mod urdf;
