# Included by the project: the files that draw are compiled one by one, though all others are joined.
cmake_language(DEFER CALL set_property TARGET daylit_engine PROPERTY UNITY_BUILD OFF)
