//! Scenes from other formats.

pub mod urdf;
