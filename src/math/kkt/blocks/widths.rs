//! Kernels with the widths of blocks as constants.

/// Calls a method with the widths of a run's columns and of their partners as constants, and their product: those of
/// usual joints (one row, hinge and sphere in the plane and in space), or another method for the other runs.
macro_rules! by_widths {
    ($run:ident, $part:ident, $alike:ident, $mixed:ident) => {
        match ($run.width, $run.partner_width) {
            (1, 1) => $part.$alike::<1, 1, 1>($run),
            (2, 1) => $part.$alike::<2, 1, 2>($run),
            (2, 2) => $part.$alike::<2, 2, 4>($run),
            (3, 1) => $part.$alike::<3, 1, 3>($run),
            (3, 2) => $part.$alike::<3, 2, 6>($run),
            (3, 3) => $part.$alike::<3, 3, 9>($run),
            (5, 5) => $part.$alike::<5, 5, 25>($run),
            (6, 1) => $part.$alike::<6, 1, 6>($run),
            (6, 3) => $part.$alike::<6, 3, 18>($run),
            (6, 5) => $part.$alike::<6, 5, 30>($run),
            (1, _) => $part.$mixed::<1>($run),
            (2, _) => $part.$mixed::<2>($run),
            (3, _) => $part.$mixed::<3>($run),
            (4, _) => $part.$mixed::<4>($run),
            (5, _) => $part.$mixed::<5>($run),
            (6, _) => $part.$mixed::<6>($run),
            (7, _) => $part.$mixed::<7>($run),
            _ => $part.$mixed::<{ crate::math::kkt::blocks::groups::LARGEST }>($run),
        }
    };
}

/// The same for bodies, whose points with all their translations in the plane and in space are levers.
macro_rules! by_kinds {
    ($run:ident, $part:ident, $levers:ident::<$plane:tt, $space:tt>, $alike:ident, $mixed:ident) => {
        match ($run.are_levers, $run.width, $run.partner_width) {
            (true, 3, 2) => by_kinds!(@ $part.$levers $plane($run)),
            (true, 6, 3) => by_kinds!(@ $part.$levers $space($run)),
            _ => by_widths!($run, $part, $alike, $mixed),
        }
    };
    (@ $part:ident.$levers:ident [$($n:literal),*]($run:ident)) => { $part.$levers::<$($n),*>($run) };
}
