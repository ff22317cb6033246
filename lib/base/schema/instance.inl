BEGIN(hair_context_desc)
POINTER(hair_context_desc, host, "Callbacks.")
POINTER(hair_context_desc, get_proc, "Function that returns the address of an OpenGL function, or NULL.")
POINTER(hair_context_desc, get_proc_user, "Pointer passed to get_proc.")
ENUM(hair_context_desc, gl_state, HAIR_GL_STATE_RESTORE,
      "Treatment of the OpenGL state by calls that use OpenGL.", "restore", "clobber")
BOOL(hair_context_desc, timings, false,
      "Measurement of the GPU time of passes, for hair_get_timings() and hair_report().")
POINTER(hair_context_desc, glsl_dir, "Directory from which the shaders of glsl/ are read, for development.")
POINTER(hair_context_desc, cache, "Cache of program binaries.")
BOOL(hair_context_desc, restorable, false, "Preparation for hair_context_restore().")
END
BEGIN(hair_desc)
POINTER(hair_desc, label, "Name in the log and in GPU debuggers, copied.")
ENUM(hair_desc, solver, HAIR_SOLVER_DIRECT,
      "Time integration of the guides.", "direct", "accurate", "follow", "redblack")
AUTO_FLOAT(hair_desc, substep, 0, 0.1, 0, 0.0167, LINEAR, "s", "Length of a substep, at least 1e-5 s.")
ENUM(hair_desc, thread_mapping, HAIR_THREAD_MAPPING_AUTO,
      "Mapping of guides to GPU threads.", "auto", "workgroup_per_guide", "thread_per_guide", "feedback")
FLOAT(hair_desc, max_dt, 0.1, 1e-3, 1, 0.01, 0.25, LINEAR, "s", "Maximum time that one hair_step() advances.")
POINTER(hair_desc, physics, "Initial physics.")
POINTER(hair_desc, look, "Initial look.")
MATRIX(hair_desc, transform, IDENTITY, "Initial pose of the head, groom to world.")
FLOAT(hair_desc, field_voxel, 0.005, 0.0005, 1, 0.002, 0.02, LOG, "m",
      "Size of a voxel of the field, see hair_field_info.")
ENUM(hair_desc, hit_method, HAIR_HIT_METHOD_AUTO,
      "Method that finds the first vertex of a follower inside a collider.", "auto", "compute", "prepass")
BOOL(hair_desc, diagnose, false, "Measurement of the energy of guides, for hair_solver_stats.gaining.")
END
