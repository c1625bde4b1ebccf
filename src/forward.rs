//! Methods that only pass their arguments on.

/// Methods by the methods of the same name: of another trait of the value, `Trait =>`, of its field, `.field =>`, or of
/// what a method of its field returns, `.field.method() =>`.
macro_rules! forward {
    (.$inner:ident => $(fn $name:ident(&self $(, $argument:ident: $type:ty)*) $(-> $output:ty)?;)*) => {
        $(fn $name(&self $(, $argument: $type)*) $(-> $output)? {
            self.$inner.$name($($argument),*)
        })*
    };
    (.$inner:ident.$call:ident() => $(fn $name:ident(&self $(, $argument:ident: $type:ty)*) $(-> $output:ty)?;)*) => {
        $(fn $name(&self $(, $argument: $type)*) $(-> $output)? {
            self.$inner.$call().$name($($argument),*)
        })*
    };
    ($kernel:ident => $(fn $name:ident(&self $(, $argument:ident: $type:ty)*) $(-> $output:ty)?;)*) => {
        $(fn $name(&self $(, $argument: $type)*) $(-> $output)? {
            $kernel::$name(self $(, $argument)*)
        })*
    };
}
pub(crate) use forward;
