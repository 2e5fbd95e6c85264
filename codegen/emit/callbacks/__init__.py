"""What the runtime calls, and the tables that it reads (runtime/include/mdl_abi.h)."""
