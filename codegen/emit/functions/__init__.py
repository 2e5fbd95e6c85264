"""C functions beside the callbacks: helpers, the solver of nonlinear blocks, functions of the model."""
