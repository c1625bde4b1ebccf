//! A method of linearization: its request, its result and its entry in the registry.

use super::{Changes, Chart, Matrix, Variation};
use crate::error::Result;
use crate::method_spec::{Listed, MethodSpec, OptionDoc};

/// The method and the chart of a linear model.
#[derive(Clone, Debug, PartialEq)]
pub struct Request {
    /// Method with its options.
    pub method: MethodSpec,
    /// Chart of minimal coordinates; none: `intrinsic` where the equations allow it, else `mass_orthogonal`.
    pub chart: Option<Chart>,
}

impl Request {
    pub(super) fn chart(&self, variation: &mut Variation) -> Chart {
        self.chart.clone().unwrap_or_else(|| Chart::preferred(variation))
    }
}

/// The matrices of E x' = A x + B u, y = C x + D u.
pub struct Built {
    /// Name of the chart.
    pub chart: String,
    /// Names of the states x.
    pub states: Vec<String>,
    /// A, n_x x n_x.
    pub a: Matrix,
    /// B, n_x x n_u.
    pub b: Matrix,
    /// C, n_y x n_x.
    pub c: Matrix,
    /// D, n_y x n_u.
    pub d: Matrix,
    /// E, n_x x n_x; none: I.
    pub e: Option<Matrix>,
    /// (dq, dv) of a unit of each state.
    pub changes: Changes,
    /// Number of infinite eigenvalues.
    pub infinite: usize,
}

/// A method as the command line and the table of methods list it.
pub struct Entry {
    /// Name on the command line.
    pub name: &'static str,
    /// One line of description.
    pub about: &'static str,
    /// Options that it takes.
    pub options: &'static [OptionDoc],
    /// Builds the matrices at the state of a variation.
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
