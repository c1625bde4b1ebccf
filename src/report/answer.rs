//! The result of a command.

use super::{Folder, Origin, Sealed};
use crate::error::Result;
use serde::Serialize;

pub trait Answer {
    /// Returns the contents of the JSON file.
    fn json(&self) -> impl Serialize;

    /// Returns the text for a terminal.
    fn text(&self) -> String;

    /// Writes tables and figures, in the order in which they are listed; `stem` is the name of the JSON file without
    /// extension.
    fn write(&self, _folder: &mut Folder, _stem: &str) -> Result<()> {
        Ok(())
    }

    /// Writes all files, the JSON last: it vouches for the others.
    fn stage<'a, O: Into<Option<Origin>>>(
        &'a self,
        folder: &mut Folder,
        stem: &str,
        origin: O,
    ) -> Result<Sealed<impl Serialize + use<'a, Self, O>>> {
        self.write(folder, stem)?;
        folder.seal(&format!("{stem}.json"), origin, self.json())
    }
}

/// Serializes an object with these keys, in their order. A key with a condition is left out where that does not hold.
macro_rules! object {
    ($serializer:expr, $($key:literal $(if $condition:expr)? => $value:expr),* $(,)?) => {{
        use serde::ser::SerializeMap;
        let mut object = $serializer.serialize_map(None)?;
        $($(if $condition)? { object.serialize_entry($key, &$value)?; })*
        object.end()
    }};
}

pub(crate) use object;
