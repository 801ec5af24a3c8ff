// Large arrays lie on huge pages: a scene's triangles and textures are read at random, and where pages are small the
// processor looks up most of them in tables that it does not hold either (4 to 7 % of the time of streets).
// Replaces the program's operator new; what is small is left to malloc.
#include <sys/mman.h>

#include <cstdlib>
#include <new>

namespace {

constexpr size_t huge_page = 1 << 21, smallest_large = 2 * huge_page;  // bytes

void* allocate_large(size_t size) {
    void* memory = nullptr;
    if (posix_memalign(&memory, huge_page, size) != 0) return nullptr;
    madvise(memory, size / huge_page * huge_page, MADV_HUGEPAGE);  // a wish: without it all works as well
    return memory;
}

}  // namespace

void* operator new(size_t size) {
    for (;;) {
        if (void* memory = size < smallest_large ? std::malloc(size > 0 ? size : 1) : allocate_large(size))
            return memory;
        const std::new_handler handler = std::get_new_handler();
        if (!handler) throw std::bad_alloc();
        handler();
    }
}

void operator delete(void* memory) noexcept {
    std::free(memory);
}
void operator delete(void* memory, size_t) noexcept {
    std::free(memory);
}
