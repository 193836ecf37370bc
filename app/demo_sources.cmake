# The live demo: everything of the window but the command line.
set(DEMO_SOURCES
  canvas.cpp capture.cpp compare_view.cpp compare_worker.cpp demo.cpp hash_grid.cpp hash_view.cpp help.cpp interface.cpp overlay_shapes.cpp palette.cpp panel.cpp
  panel_detection.cpp panel_numbers.cpp scene_view.cpp session.cpp shortcuts.cpp status.cpp surface_view.cpp surface_watch.cpp sweep_plot.cpp sweep_view.cpp sweep_worker.cpp true_surfaces.cpp widgets.cpp)
