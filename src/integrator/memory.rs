//! What methods carry from step to step, as numbers in a row.

/// Reads them in the order in which they were written; zeros where there are no more.
pub(super) struct Reader<'m>(pub &'m [f64]);

impl<'m> Reader<'m> {
    pub fn number(&mut self) -> f64 {
        self.slice(1).first().copied().unwrap_or_default()
    }

    pub fn slice(&mut self, len: usize) -> &'m [f64] {
        let (head, rest) = self.0.split_at(len.min(self.0.len()));
        self.0 = rest;
        head
    }

    pub fn fill(&mut self, out: &mut [f64]) {
        let from = self.slice(out.len());
        out.iter_mut().zip(from).for_each(|(out, from)| *out = *from);
    }

    pub fn rest(self) -> &'m [f64] {
        self.0
    }
}
