// pool.c - threads that run the tasks of the library.
//
// Each run starts its threads, which takes far less time than the guides of a large groom.
#define _POSIX_C_SOURCE 200809L
#include "tools/bench/pool.h"

#include <pthread.h>
#include <stdatomic.h>
#include <unistd.h>

#define MAX_THREADS 64

struct job {
    hair_task task;
    void* data;
    uint32_t count;
    atomic_uint next; // next task that no thread has taken
};

static uint32_t processors(void)
{
    long count = sysconf(_SC_NPROCESSORS_ONLN);
    return count < 1 ? 1 : count > MAX_THREADS ? MAX_THREADS : (uint32_t)count;
}

static void* work(void* data)
{
    struct job* job = data;
    for (uint32_t i; (i = atomic_fetch_add(&job->next, 1)) < job->count;) job->task(i, job->data);
    return NULL;
}

static void run(hair_task task, void* data, uint32_t count, void* user)
{
    (void)user;
    struct job job = {.task = task, .data = data, .count = count};
    pthread_t threads[MAX_THREADS];
    uint32_t started = 0;
    while (started + 1 < processors() && started + 1 < count &&
           !pthread_create(&threads[started], NULL, work, &job))
        ++started;
    work(&job);
    for (uint32_t i = 0; i < started; ++i) pthread_join(threads[i], NULL);
}

hair_tasks bench_pool_tasks(uint32_t* threads)
{
    *threads = processors();
    return (hair_tasks){.run = run};
}
