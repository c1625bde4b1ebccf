//! Methods from outside the crate.

use super::Listed;
use crate::error::{Error, Result};
use std::any::Any;
use std::sync::Arc;

/// Entries from outside the crate, which are in no registry.
#[derive(Clone, Debug, Default)]
pub struct OwnMethods(Option<Arc<[Own]>>);

type Own = &'static (dyn Any + Send + Sync);

impl OwnMethods {
    /// This entry alone.
    pub(super) fn of<E: Listed>(entry: &'static E) -> Self {
        OwnMethods(Some(Arc::new([entry as Own])))
    }

    /// The same with an entry more.
    ///
    /// # Errors
    /// A name that is taken.
    pub(crate) fn with<E: Listed>(&self, entry: &'static E) -> Result<Self> {
        let name = entry.name();
        if self.entries::<E>().chain(E::registry()).any(|known| known.name() == name) {
            return Err(Error::input(format!("the {} `{name}` is there already", E::KIND))
                .hint(format!("give your {} another name", E::KIND)));
        }
        Ok(OwnMethods(Some(self.all().iter().copied().chain([entry as Own]).collect())))
    }

    /// The entries of one kind of method, in the order in which they were given.
    pub(crate) fn entries<E: Listed>(&self) -> impl Iterator<Item = &'static E> {
        self.all().iter().filter_map(|own| own.downcast_ref())
    }

    pub(super) fn is_empty(&self) -> bool {
        self.0.is_none()
    }

    fn all(&self) -> &[Own] {
        self.0.as_deref().unwrap_or_default()
    }
}

/// Own methods take no part in comparison: specifications of one name and options are equal.
impl PartialEq for OwnMethods {
    fn eq(&self, _: &Self) -> bool {
        true
    }
}
