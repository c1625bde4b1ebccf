//! The values that methods carry from step to step, as a sequence of numbers.

/// Reads the numbers in the order of writing; zeros after the last.
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
