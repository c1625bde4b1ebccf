//! Extremes that the equations allow: masses, stiffnesses, lengths and speeds that are far apart. What each method keeps of
//! a solution in 32 digits, and the same digits in any units.

mod chain;
mod double_double;
mod masses;
mod massless;
mod saddle;
mod scales;
mod stiffness;
mod units;
