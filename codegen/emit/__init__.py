"""C of a structured model, against runtime/include/mdl_abi.h."""
