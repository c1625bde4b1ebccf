//! Kernels with the widths of blocks as constants.

/// Calls a method with the number of unknowns of a group as a constant.
macro_rules! by_width {
    ($width:expr, $part:ident.$method:ident($($argument:expr),*)) => {
        match $width {
            1 => $part.$method::<1>($($argument),*),
            2 => $part.$method::<2>($($argument),*),
            3 => $part.$method::<3>($($argument),*),
            4 => $part.$method::<4>($($argument),*),
            5 => $part.$method::<5>($($argument),*),
            6 => $part.$method::<6>($($argument),*),
            7 => $part.$method::<7>($($argument),*),
            _ => $part.$method::<{ crate::math::kkt::blocks::groups::LARGEST }>($($argument),*),
        }
    };
}

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
            _ => by_width!($run.width, $part.$mixed($run)),
        }
    };
}

/// Calls a method for levers, points with all their translations in the plane and in space, or another one.
macro_rules! by_kinds {
    ($run:ident, $part:ident, $levers:ident::<$plane:tt, $space:tt>, $blocks:ident) => {
        match ($run.are_levers, $run.width) {
            (true, 3) => by_kinds!(@ $part.$levers $plane($run)),
            (true, 6) => by_kinds!(@ $part.$levers $space($run)),
            _ => by_width!($run.width, $part.$blocks($run)),
        }
    };
    (@ $part:ident.$levers:ident [$($n:literal),*]($run:ident)) => { $part.$levers::<$($n),*>($run) };
}
