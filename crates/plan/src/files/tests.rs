mod examples;
mod mutated;
mod round;
