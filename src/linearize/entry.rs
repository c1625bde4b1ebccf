//! What a method of linearization is asked for, and what it makes.

use super::{Changes, Chart, Matrix, Variation};
use crate::error::Result;
use crate::method_spec::{Listed, MethodSpec, OptionDoc};

/// What is asked for.
#[derive(Clone, Debug, PartialEq)]
pub struct Request {
    pub method: MethodSpec,
    /// Of minimal coordinates; none: `intrinsic` where the equations allow it, else `mass_orthogonal`.
    pub chart: Option<Chart>,
}

impl Request {
    pub(super) fn chart(&self, variation: &mut Variation) -> Chart {
        self.chart.clone().unwrap_or_else(|| Chart::preferred(variation))
    }
}

/// The matrices of a method.
pub struct Built {
    pub chart: String,
    pub states: Vec<String>,
    pub a: Matrix,
    pub b: Matrix,
    pub c: Matrix,
    pub d: Matrix,
    pub e: Option<Matrix>,
    /// (dq, dv) of each state.
    pub changes: Changes,
    /// How many eigenvalues are infinite.
    pub infinite: usize,
}

/// One method as the command line and the table of methods know it.
pub struct Entry {
    pub name: &'static str,
    pub about: &'static str,
    pub options: &'static [OptionDoc],
    pub build: fn(&mut Variation, &Request) -> Result<Built>,
}

impl Listed for Entry {
    const KIND: &'static str = "method";

    fn name(&self) -> &'static str {
        self.name
    }

    fn options(&self) -> &'static [OptionDoc] {
        self.options
    }
}
