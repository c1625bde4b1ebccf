mod evaluate;
mod tangent;
