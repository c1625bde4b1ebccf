//! Accepted steps and solutions allocate nothing.

mod allocation;
mod common;
mod kkt_allocation;

#[global_allocator]
static ALLOCATOR: common::counting::Counting = common::counting::Counting;
