mod assignment;
mod deflate;
mod exponential;
mod krylov;
mod pencil;
mod samples;
mod second_order;
mod standard;
