//! The values that methods carry from step to step, as they are saved.

use serde::Serialize;
use serde::de::DeserializeOwned;
use serde_json::Value;

/// The values as JSON.
pub(super) fn written(memory: impl Serialize) -> Option<Value> {
    serde_json::to_value(memory).ok()
}

/// The values again; `None` for those of another version, from which a method begins anew.
pub(super) fn read<M: DeserializeOwned>(memory: &Value) -> Option<M> {
    M::deserialize(memory).ok()
}

/// Sets the values that are saved.
pub(super) fn fill(values: &mut [f64], saved: &[f64]) {
    values.iter_mut().zip(saved).for_each(|(value, saved)| *value = *saved);
}
