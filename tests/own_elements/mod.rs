//! Elements from outside the crate, in every layer: the mechanism that they make against the same one written as own
//! equations, and own copies of built-in ones against these.

mod bodies;
mod equations;
mod lagrangian;
mod methods;
mod passes;
mod refused;
mod settings;
mod subjects;
