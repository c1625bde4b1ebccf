//! Flexible beams in absolute coordinates: the element, its statics against closed forms, frequencies, large motions, and
//! what is refused.

mod buckling;
mod dynamics;
mod element;
mod errors;
mod frequencies;
mod large;
mod shooting;
mod statics;
mod tapered;
