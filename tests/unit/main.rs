//! The tests inside of source files, which need what is private there.
//!
//! Only the files below are compiled for them, not the whole library a second time. They see each other as they do in
//! the library. A test of something that needs more of it belongs into another folder of `tests`.
#![allow(dead_code, unused_imports, unused_macros)]
// As in the library.
#![allow(clippy::suspicious_arithmetic_impl)]

#[path = "../../src/body/mod.rs"]
mod body;
#[path = "../../src/clock.rs"]
mod clock;
#[path = "../../src/error/mod.rs"]
mod error;
#[path = "../../src/files/mod.rs"]
mod files;
#[path = "../../src/forward.rs"]
mod forward;
#[path = "../../src/math/mod.rs"]
mod math;
#[path = "../../src/plot/mod.rs"]
mod plot;
#[path = "../../src/tolerances.rs"]
mod tolerances;

#[path = "../../src/analysis"]
mod analysis {
    mod ledger;
    mod thinned;
    pub use ledger::Ledger;
    mod held {
        mod end;
    }
}

#[path = "../../src/cli"]
mod cli {
    mod terminal;
}

#[path = "../../src/import"]
mod import {
    mod close;
    mod names;
    mod transform;
    mod xml;
    mod scene {
        mod valid;
    }
}

#[path = "../../src/integrator"]
mod integrator {
    mod stability;
    mod adams {
        mod coefficients;
    }
    mod radau_iia {
        mod collocation;
    }
}

#[path = "../../src/linearize"]
mod linearize {
    mod least_norm;
    pub use nalgebra::Complex;
    pub type Matrix = nalgebra::DMatrix<f64>;
}

#[path = "../../src/modes"]
mod modes {
    pub mod natural;
    mod rate_bound;
}

#[path = "../../src/report"]
mod report {
    mod linear {
        mod phase;
        mod ranges;
        mod rays;
    }
    mod mechanism {
        mod hull;
        mod view;
    }
}

#[path = "../../src/scene"]
mod scene {
    mod fingerprint;
    mod json;
    pub mod locate;
    pub mod units;
    mod document {
        mod budget;
        mod edit;
        mod refine;
        mod repeat;
        mod scaled;
    }
}

#[path = "../../src/simplify"]
mod simplify {
    mod grid;
}

#[path = "../../src/simulate"]
mod simulate {
    mod passage;
    mod events {
        mod range;
    }
}

#[path = "../../src/study"]
mod study {
    mod numbers;
    mod pool;
    mod queue;
    mod stress {
        mod ladder;
        mod period;
    }
    mod variants {
        mod plan;
        mod points;
    }
}

#[path = "../../src/sweep"]
mod sweep {
    mod range;
    pub use range::Range;
}

#[path = "../../src/validate"]
mod validate {
    mod deviation;
    mod limit;
    mod order;
}

#[path = "../../src/view"]
mod view {
    mod encode;
    mod rows;
}
