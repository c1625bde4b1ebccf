//! The element itself: objective, exact derivatives, exact statics.
