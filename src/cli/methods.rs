//! `holonom methods`

use super::common::print;
use crate::error::Result;
use crate::formulation::OptionDoc;
use crate::report::Table;
use crate::{formulation, integrator, projection};
use std::process::ExitCode;

pub fn run() -> Result<ExitCode> {
    let mut text = String::from("A method is a formulation, an integrator and a projection, chosen independently.\n\n");
    let mut formulations = Table::left(&["formulation", "what is integrated", "options"]);
    for entry in formulation::registry() {
        formulations.row([entry.name.to_string(), entry.about.to_string(), options(entry.options)]);
    }
    let mut integrators = Table::left(&["integrator", "order", "integrates", ""]);
    for entry in integrator::registry() {
        let fields = entry.accepts == integrator::VECTOR_FIELDS;
        let accepts = if fields { "vector fields".to_string() } else { entry.accepts.join(" ") };
        integrators.row([entry.name.to_string(), entry.order.to_string(), accepts, entry.about.to_string()]);
    }
    let mut projections = Table::left(&["projection", "after each step", "options"]);
    for entry in projection::registry() {
        projections.row([entry.name.to_string(), entry.about.to_string(), options(entry.options)]);
    }
    text += &format!("{formulations}\n{integrators}\n{projections}\n");
    text += &format!(
        "Vector fields are {}.\nOrders hold for q, v and lambda with every projection that is not refused. Write options as \
         baumgarte:alpha=5,beta=5.\n",
        integrator::VECTOR_FIELDS.join(", ")
    );
    print(&text)?;
    Ok(ExitCode::SUCCESS)
}

fn options(options: &[OptionDoc]) -> String {
    options.iter().map(|option| option.name).collect::<Vec<_>>().join(" ")
}
