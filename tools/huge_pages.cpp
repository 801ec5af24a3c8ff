// All memory lies on huge pages where the system has some: a scene's triangles, textures and streaks are read at
// random, and where pages are small the processor looks up most of them in tables that it does not hold either. The
// city street in the rain takes 0.85 of the time. A wish: without huge pages all works as well.

extern "C" {

/// Read by jemalloc when it starts.
extern const char* malloc_conf;
const char* malloc_conf = "thp:always";
}
