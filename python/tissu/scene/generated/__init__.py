"""Made by `make codegen` from python/tissu/codegen; never edited."""
